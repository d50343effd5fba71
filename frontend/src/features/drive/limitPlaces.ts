// Where a servo's limits lie on the track of its slider, and on which side of them their figures stand, so that the estimate
// crosses none where it has come to an end. Pure.

import type { CSSProperties } from 'react';
import { fraction } from '../picture/pose.ts';
import type { Range } from '#shared/codec/families.ts';

/** Between the two ends, outside of both, or both beyond one of them where the track ends at the other. */
export type FiguresAt = 'within' | 'around' | 'after' | 'before';

/** Of the narrowest page, so that a way that is wide enough here is so everywhere. */
const NARROWEST_TRACK_PX = 250;
const CHARACTER_PX = 7;
/** Between a figure and an end of the way. */
const BESIDE_PX = 5;

export function figuresAt(
  limits: Range,
  range: Range,
  [lowest, highest]: readonly [string, string],
): FiguresAt {
  const { from, to } = shares(limits, range);
  const gapPx = 2 * BESIDE_PX;
  if (widthPx(lowest + highest) + 2 * gapPx <= (to - from) * NARROWEST_TRACK_PX) return 'within';
  if (widthPx(lowest) + BESIDE_PX > from * NARROWEST_TRACK_PX) return 'after';
  return widthPx(highest) + BESIDE_PX > (1 - to) * NARROWEST_TRACK_PX ? 'before' : 'around';
}

/** From where to where the limits lie on the track, as shares of it. */
export const between = (limits: Range, range: Range): CSSProperties => {
  const { from, to } = shares(limits, range);
  return { ['--from' as string]: from.toFixed(4), ['--to' as string]: to.toFixed(4) };
};

const shares = ({ min, max }: Range, range: Range): { readonly from: number; readonly to: number } => ({
  from: Math.max(0, fraction(min, range)),
  to: Math.min(1, fraction(max, range)),
});

const widthPx = (figures: string): number => figures.length * CHARACTER_PX;
