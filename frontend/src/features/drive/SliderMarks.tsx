// The marks that move on a slider: the thumb is the target, the bar below it the estimate. On a canvas, because dozens of them
// change in each frame.

import { useRef } from 'react';
import type { Size } from '../picture/Canvas.tsx';
import { Drawing } from '../picture/Drawing.tsx';
import { motionInFrame } from '../picture/motionInFrame.ts';
import { fraction } from '../picture/pose.ts';
import type { Range } from '#shared/codec/families.ts';
import { useStores } from '../stores.ts';
import { paintMarks, thumbOf, type Thumb } from './paintMarks.ts';
import styles from './SliderMarks.module.css';

export interface SliderMarksProps {
  readonly servo: number;
  /** From the track's one end to its other. */
  readonly range: Range;
  readonly isKnown: boolean;
  readonly isBlocked: boolean;
  thumbAt(): number;
  isHeld(): boolean;
}

export function SliderMarks({ servo, range, isKnown, isBlocked, thumbAt, isHeld }: SliderMarksProps) {
  const { device } = useStores();
  const place = useRef<HTMLDivElement>(null);
  const measured = useRef<{ readonly size: Size; readonly thumb: Thumb } | null>(null);

  /** Its measures are the style sheet's, and another only where the size of all of it is. */
  function thumbIn(size: Size): Thumb | null {
    if (place.current === null) return null;
    if (measured.current?.size !== size) measured.current = { size, thumb: thumbOf(place.current) };
    return measured.current.thumb;
  }

  return (
    <div ref={place} className={styles.marks}>
      <Drawing
        className={styles.canvas}
        shown={() => {
          const { estimated } = motionInFrame(device, servo);
          const estimate = estimated === null ? null : fraction(estimated, range);
          return [fraction(thumbAt(), range), estimate, isHeld(), isKnown, isBlocked] as const;
        }}
        paint={(pen, [target, estimate, isHeldNow, isKnownNow, isBlockedNow]) => {
          const thumb = thumbIn(pen.size);
          const state = { isHeld: isHeldNow, isKnown: isKnownNow, isBlocked: isBlockedNow };
          if (thumb !== null) paintMarks(pen, thumb, { target, estimate, ...state });
        }}
      />
    </div>
  );
}
