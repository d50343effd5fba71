// How long a move from the sliders takes. "As fast as my hand" follows the pointer, yet never asks a servo for more than it
// can turn: a click at the far end of a slider stays a motion one can follow. A leap has no hand that leads it, so it is
// slower. Knows no session.

import type { ServoTarget } from '#shared/codec/commands.ts';
import type { Family } from '#shared/codec/families.ts';
import type { Motions } from '#shared/robot/state.ts';
import { FIRST_MOVE_MS } from '#shared/robot/timings.ts';

/** `hand`: as fast as the session's soft limit allows; or milliseconds set by the person. */
export type MoveTime = 'hand' | number;
/** `leap`: to a figure that was typed, to an end or home, at one stroke. */
export type Pace = MoveTime | 'leap';

/** A whole range in 2 s: time to see that it is the wrong way. */
const LEAP_RANGE_MS = 2000;
const LEAP_MIN_MS = 300;
/** `Centre all` and first poses: slow enough to step back. */
export const GENTLE_MOVE_MS = FIRST_MOVE_MS;

export function moveDurationMs(
  pace: Pace,
  targets: readonly ServoTarget[],
  { position }: Family,
  motion: Motions,
): number {
  if (typeof pace === 'number') return pace;
  if (pace === 'hand') return 0;
  const span = position.max - position.min;
  const ways = targets.map((target) => {
    const from = motion(target.servo).estimated;
    return from === null ? 1 : Math.abs(target.position - from) / span;
  });
  return Math.round(Math.max(LEAP_MIN_MS, ...ways.map((way) => way * LEAP_RANGE_MS)));
}
