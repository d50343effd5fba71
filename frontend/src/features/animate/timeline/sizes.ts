// How large the parts of the timeline are: fine for a mouse, large enough for a finger. What is fixed on top is the ruler, the
// heads of the frames and the row of all servos; the other rows scroll below.

import type { RowHeights } from './rows.ts';

export interface Sizes extends RowHeights {
  readonly ruler: number;
  readonly heads: number;
  /** How far beside a thing it is still hit. */
  readonly reach: number;
}

const FINE: Sizes = { ruler: 22, heads: 22, summary: 26, servo: 28, reach: 8 };
const COARSE: Sizes = { ruler: 44, heads: 44, summary: 44, servo: 44, reach: 22 };
const TALL_PX = 104;

export function sizesOf(isCoarse: boolean, isTall: boolean): Sizes {
  const sizes = isCoarse ? COARSE : FINE;
  return isTall ? { ...sizes, servo: TALL_PX } : sizes;
}

export const topOfAll = ({ ruler, heads }: Sizes): number => ruler + heads;
export const topOfRows = (sizes: Sizes): number => topOfAll(sizes) + sizes.summary;
