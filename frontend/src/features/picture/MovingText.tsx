// A number that changes by itself, drawn while it does: text that changes has the page laid out and painted anew. Beneath it the
// text follows for whoever does not see, four times a second where few change, every other second where many do; at rest it is
// text like any other.

import { useRef, useEffect, useLayoutEffect, useState } from 'react';
import type { LookName, Pen, Size } from './Canvas.tsx';
import { cx } from '../../ui/cx.ts';
import { setText } from '../../ui/LiveText.tsx';
import type { FollowedTextProps } from '../../ui/NumberField.tsx';
import { dueOn, CHANGING_EACH_MS, HEARD_EACH_MS, READABLE_MS, useFollow } from '../../ui/useEachFrame.ts';
import { Drawing } from './SharedSheet.tsx';
import styles from './MovingLabel.module.css';
import overlay from './overlay.module.css';

// A number that changes by itself, in a place of fixed size.

interface MovingLabelProps {
  /** Asked for what is to stand there now. */
  text(): string;
  readonly colour: LookName;
  /** Gives it a width and a height. */
  readonly className: string | undefined;
  /** What kind of number it is: for whoever points at it, and for ears. */
  readonly title?: string;
  /** It changes all the time, and something else says it to screen readers. */
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

/** On an element whose text is drawn instead. */
const DRAWN = 'data-drawn';
/** Target and estimate of as many servos as two sticks move. Nobody listens to more at once. */
const FEW = 8;
/** Those that are drawn now. */
const changing = new Set<object>();

interface MovingTextProps extends Omit<FollowedTextProps, 'colour'> {
  readonly colour: LookName;
}

/** Over `element`, in its font, in its middle where its text is, else from its end. */
export function MovingText({ element, colour, text, write }: MovingTextProps) {
  /** What is drawn; null while it is text. */
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

/** Measured once: to ask for it in each frame would cost more than to draw. */
interface Type {
  readonly size: Size;
  readonly isFontThere: boolean;
  readonly font: string;
  readonly align: 'center' | 'right';
  readonly baseLine: number;
}

/** The base line is where that of a line of text as high as the element is. */
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
