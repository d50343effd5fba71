// A number that changes by itself, in a place of fixed size.

import { useRef } from 'react';
import type { LookName } from './look.ts';
import { cx } from '../../ui/cx.ts';
import { setText } from '../../ui/setText.ts';
import { MovingText } from './MovingText.tsx';
import styles from './MovingLabel.module.css';

export interface MovingLabelProps {
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
