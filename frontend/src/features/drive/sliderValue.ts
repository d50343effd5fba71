// Where on its way a slider's thumb stands, where a pointer takes hold of it, and which value it gives it then. Pure.

import type { Range } from '#shared/codec/families.ts';

/** What the middle of the thumb goes along, and the values at its ends. */
export interface Way extends Range {
  readonly fromPx: number;
  readonly lengthPx: number;
}

export function valueAt({ fromPx, lengthPx, min, max }: Way, atPx: number): number {
  const share = Math.min(1, Math.max(0, (atPx - fromPx) / lengthPx));
  return min + Math.round(share * (max - min));
}

export function placeOf({ fromPx, lengthPx, min, max }: Way, value: number): number {
  return fromPx + ((value - min) / (max - min || 1)) * lengthPx;
}

export interface Press {
  readonly atPx: number;
  /** The thumb takes it so far beside its middle. */
  readonly reachPx: number;
  /** It may be there to scroll. */
  readonly isFinger: boolean;
}

/** How far beside the thumb's middle it holds the thumb, which stands at `value`. null: a finger that only brushes the slider. */
export function gripOf(way: Way, value: number, { atPx, reachPx, isFinger }: Press): number | null {
  const besidePx = atPx - placeOf(way, value);
  if (Math.abs(besidePx) <= reachPx) return besidePx;
  return isFinger ? null : 0;
}

export interface Point {
  readonly x: number;
  readonly y: number;
}

/** Beyond what a finger trembles. */
const TREMBLE_PX = 6;

/** A finger that goes there drags; up or down it scrolls. */
export function isSideways(from: Point, to: Point): boolean {
  const [x, y] = [Math.abs(to.x - from.x), Math.abs(to.y - from.y)];
  return x > TREMBLE_PX && x > y;
}
