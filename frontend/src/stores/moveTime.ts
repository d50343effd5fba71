// How long a move from the sliders takes. "As fast as my hand" follows the pointer, yet never asks a servo for more than it
// can turn: a click at the far end of a slider stays a motion one can follow. Knows no session.

import type { ServoTarget } from '#shared/protocol/commands.ts';
import type { Family } from '#shared/protocol/families.ts';
import type { ServoMotion } from '#shared/session/state.ts';

/** `hand`, or milliseconds set by the person. */
export type MoveTime = 'hand' | number;

/** A whole range in 0.7 s: what a common servo of these robots manages at 6 V with a load. */
const RANGE_MS = 700;
/** `Centre all` and first poses: slow enough to step back. */
export const GENTLE_MOVE_MS = 1500;

export function moveDurationMs(
  time: MoveTime,
  targets: readonly ServoTarget[],
  { position }: Family,
  motion: (servo: number) => ServoMotion,
): number {
  if (time !== 'hand') return time;
  const span = position.max - position.min;
  const ways = targets.map((target) => {
    const from = motion(target.servo).estimated;
    return from === null ? 0 : Math.abs(target.position - from) / span;
  });
  return Math.round(Math.max(0, ...ways) * RANGE_MS);
}
