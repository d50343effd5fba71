// A text that changes by itself, written without React: at most once a frame, or no more often than it can be read, and only if it
// changed.

import { useLayoutEffect, useRef, useState } from 'react';
import { cx } from './cx.ts';
import { dueOn, CHANGING_EACH_MS, useFollow } from './useEachFrame.ts';
import styles from './LiveText.module.css';

/** Reuses the text node, because a new one needs a complete layout. */
export function setText(place: HTMLElement, text: string): void {
  const piece = place.firstChild;
  if (!(piece instanceof Text)) place.textContent = text;
  else if (piece.data !== text) piece.data = text;
}

interface LiveTextProps {
  /** Returns the current text. */
  text(): string;
  readonly eachMs?: number;
  /** If true, a changing text is written only every other second and at rest. */
  isCalm?(): boolean;
  /** The subject of the text, where comparing it is faster than the text. */
  about?(): unknown;
  readonly className?: string | undefined;
  readonly title?: string;
  /** Hidden from screen readers, because it changes constantly and is said elsewhere. */
  readonly isSilent?: boolean;
  /** `className` sets width and height, so that a new text needs no layout around it. */
  readonly isFixed?: boolean;
}

export function LiveText({
  text,
  eachMs = 0,
  isCalm = () => false,
  about = text,
  className,
  title,
  isSilent = false,
  isFixed = false,
}: LiveTextProps) {
  const place = useRef<HTMLSpanElement>(null);
  const [isDue] = useState(() => dueOn({ eachMs: CHANGING_EACH_MS }));
  const write = (): void => {
    if (place.current !== null) setText(place.current, text());
  };
  useLayoutEffect(write);
  useFollow({
    read: about,
    draw: (_, nowMs) => {
      if (!isCalm() || isDue(nowMs)) write();
    },
    rest: write,
    eachMs,
  });
  return (
    <span
      className={cx(isFixed && styles.fixed, className)}
      title={title}
      aria-hidden={isSilent ? true : undefined}
    >
      <span ref={place} />
    </span>
  );
}
