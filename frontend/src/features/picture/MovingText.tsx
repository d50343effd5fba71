// A number that changes by itself. While it changes it is drawn on a canvas, because changing text causes layout and paint of the page.
// The text below follows for screen readers: four times a second if few numbers change, every other second if many do. At rest it is
// plain text.

import { useRef, useEffect, useLayoutEffect, useState } from 'react';
import type { LookName, Pen, Size } from './Canvas.tsx';
import { cx } from '../../ui/cx.ts';
import { setText } from '../../ui/LiveText.tsx';
import type { FollowedTextProps } from '../../ui/NumberField.tsx';
import { dueOn, CHANGING_EACH_MS, HEARD_EACH_MS, READABLE_MS, useFollow } from '../../ui/useEachFrame.ts';
import { Drawing } from './SharedSheet.tsx';
import styles from './MovingLabel.module.css';
import overlay from './overlay.module.css';

interface MovingLabelProps {
  /** Returns the text to show now. */
  text(): string;
  readonly colour: LookName;
  /** Sets its width and height. */
  readonly className: string | undefined;
  /** The kind of number, as tooltip and for screen readers. */
  readonly title?: string;
  /** Hidden from screen readers, because it changes constantly and is said elsewhere. */
  readonly isSilent?: boolean;
}

export function MovingLabel({ text, colour, className, title, isSilent }: MovingLabelProps) {
  const place = useRef<HTMLSpanElement>(null);
  const write = (now: string): void => {
    if (place.current !== null) setText(place.current, now);
  };
  return (
    <span
      className={cx(styles.place, className)}
      {...(title !== undefined && { title, role: 'group' })}
      aria-hidden={isSilent}
    >
      <span ref={place} className={styles.text} />
      <MovingText element={place} {...{ text, colour, write }} />
    </span>
  );
}

/** Marks an element whose text is drawn on the canvas. */
const DRAWN = 'data-drawn';
/** Target and estimate of the four servos that two sticks move. */
const FEW = 8;
/** The numbers that are drawn now. */
const changing = new Set<object>();

interface MovingTextProps extends Omit<FollowedTextProps, 'colour'> {
  readonly colour: LookName;
}

/** Draws over `element` in its font, centred if its text is centred, else right-aligned. */
export function MovingText({ element, colour, text, write }: MovingTextProps) {
  /** The drawn text; null while the element shows it. */
  const drawn = useRef<string | null>(null);
  const written = useRef('');
  const [isDue] = useState(() => ({
    amongFew: dueOn({ eachMs: HEARD_EACH_MS }),
    amongMany: dueOn({ eachMs: CHANGING_EACH_MS }),
  }));
  const type = useRef<Type | null>(null);

  function rest(now: string): void {
    write(now);
    written.current = now;
    drawn.current = null;
    changing.delete(drawn);
    element.current?.removeAttribute(DRAWN);
  }

  function follow(now: string, nowMs: number): void {
    if (drawn.current === null && now === written.current) return;
    if (drawn.current === null) element.current?.setAttribute(DRAWN, '');
    drawn.current = now;
    changing.add(drawn);
    const [few, many] = [isDue.amongFew(nowMs), isDue.amongMany(nowMs)];
    if (changing.size <= FEW ? few : many) write(now);
  }

  function typeIn(pen: Pen): Type {
    const isFontThere = document.fonts.status === 'loaded';
    if (type.current?.size !== pen.size || type.current.isFontThere !== isFontThere)
      type.current = { size: pen.size, isFontThere, ...typeOf(pen, element.current) };
    return type.current;
  }

  useLayoutEffect(() => rest(text()));
  useEffect(() => () => void changing.delete(drawn), []);
  useFollow({ read: text, draw: follow, rest, eachMs: READABLE_MS });
  return (
    <Drawing
      className={overlay.over}
      shown={() => [drawn.current, colour, document.fonts.status] as const}
      paint={(pen, [now]) => {
        if (now !== null) paintText(pen, typeIn(pen), pen.look[colour], now);
      }}
    />
  );
}

/** Measured once: reading it in each frame would cost more than drawing. */
interface Type {
  readonly size: Size;
  readonly isFontThere: boolean;
  readonly font: string;
  readonly align: 'center' | 'right';
  readonly baseLine: number;
}

/** The baseline of a line of text as high as the element. */
function typeOf({ ctx, size }: Pen, element: HTMLElement | null): Omit<Type, 'size' | 'isFontThere'> {
  if (element === null) return { font: '', align: 'right', baseLine: 0 };
  const { fontWeight, fontSize, fontFamily, textAlign } = getComputedStyle(element);
  const font = `${fontWeight} ${fontSize} ${fontFamily}`;
  ctx.font = font;
  const { fontBoundingBoxAscent: ascent, fontBoundingBoxDescent: descent } = ctx.measureText('0');
  const align = textAlign === 'center' ? 'center' : 'right';
  return { font, align, baseLine: Math.floor((size.height + Math.round(ascent) - Math.round(descent)) / 2) };
}

function paintText({ ctx, size }: Pen, { font, align, baseLine }: Type, colour: string, text: string): void {
  ctx.font = font;
  ctx.fillStyle = colour;
  ctx.textAlign = align;
  ctx.fillText(text, align === 'center' ? size.width / 2 : size.width, baseLine);
}
