// A text that changes by itself, written past React: at most once a frame, or no more often than it can be read, and only
// where it has become another one.

import { useLayoutEffect, useRef, useState } from 'react';
import { cx } from './cx.ts';
import { dueOn, CHANGING_EACH_MS, useFollow } from './useEachFrame.ts';
import styles from './LiveText.module.css';

// Writes a text past React.

/** The same piece of text, where there is one: another one would be laid out anew from the ground. */
export function setText(place: HTMLElement, text: string): void {
  const piece = place.firstChild;
  if (!(piece instanceof Text)) place.textContent = text;
  else if (piece.data !== text) piece.data = text;
}

interface LiveTextProps {
  /** Asked for what is to stand there now. */
  text(): string;
  readonly eachMs?: number;
  /** For what is no hurry while it goes on changing: written every other second, and at rest. */
  isCalm?(): boolean;
  /** What it is about, where that is asked more quickly than the text. */
  about?(): unknown;
  readonly className?: string | undefined;
  readonly title?: string;
  /** It changes all the time, and something else says it to screen readers. */
  readonly isSilent?: boolean;
  /** `className` gives it a width and a height: another text then has nothing around it laid out anew. */
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
