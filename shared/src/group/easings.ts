// How a servo comes into its key, as curves from (0, 0) to (1, 1). Each is a line or a parabola, so that what a straight way
// misses of it is known exactly. Knows no servo and no time.

import type { Easing } from './group.ts';

export interface Curve {
  /** The share of the way that is done after `share` of the time. */
  at(share: number): number;
  /** Where within the time it is just as steep as a straight way of `slope`: there it is farthest from such a way. */
  asSteepAs(slope: number): readonly number[];
  /** The greatest slope. */
  readonly steepest: number;
}

const into: Curve = {
  at: (share) => share * share,
  asSteepAs: (slope) => [slope / 2],
  steepest: 2,
};

export const CURVES: Readonly<Record<Easing, Curve>> = {
  linear: { at: (share) => share, asSteepAs: () => [], steepest: 1 },
  in: into,
  out: {
    at: (share) => 1 - into.at(1 - share),
    asSteepAs: (slope) => [1 - slope / 2],
    steepest: 2,
  },
  inOut: {
    at: (share) => (share < 0.5 ? into.at(2 * share) / 2 : 1 - into.at(2 - 2 * share) / 2),
    asSteepAs: (slope) => [slope / 4, 1 - slope / 4],
    steepest: 2,
  },
  hold: { at: (share) => (share < 1 ? 0 : 1), asSteepAs: () => [], steepest: Infinity },
};

/** The same way seen from its end. A jump has no other end. */
export const BACKWARDS: Readonly<Record<Easing, Easing>> = {
  linear: 'linear',
  in: 'out',
  out: 'in',
  inOut: 'inOut',
  hold: 'hold',
};
