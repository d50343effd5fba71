// A text that changes by itself, written past React: at most once a frame, or no more often than it can be read, and only
// where it has become another one.

import { useLayoutEffect, useRef } from 'react';
import { cx } from './cx.ts';
import styles from './LiveText.module.css';
import { setText } from './setText.ts';
import { useFollow } from './useFollow.ts';

export interface LiveTextProps {
  /** Asked for what is to stand there now. */
  text(): string;
  readonly eachMs?: number;
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
  className,
  title,
  isSilent = false,
  isFixed = false,
}: LiveTextProps) {
  const place = useRef<HTMLSpanElement>(null);
  const write = (now: string): void => {
    if (place.current !== null) setText(place.current, now);
  };
  useLayoutEffect(() => write(text()));
  useFollow({ read: text, draw: write, eachMs });
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
