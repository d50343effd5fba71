// A servo creeps as long as a button is held: a nudge at once, then, a little later, a tenth of its range a second in small
// steps, and twice that where it is held on. The next step waits for the estimate, so that the servo stands soon after the button is
// let go. Knows no session.

import type { Clock } from '#shared/clock.ts';
import type { Range } from '#shared/codec/families.ts';
import type { ServoMotion } from '#shared/robot/state.ts';

export interface Creeping {
  readonly clock: Clock;
  /** What its board can do. */
  readonly reach: Range;
  motion(): ServoMotion;
  mayMove(): boolean;
  move(position: number, durationMs: number): void;
}

const STEP_MS = 100;
/** Longer than a tap. */
const HOLD_AFTER_MS = 350;
/** Whoever holds on so long has far to go. Half as fast as by a pad, which is slow enough to let go in time. */
const FASTER_AFTER_STEPS = 12;
const FASTER = 2;
const STEPS_A_RANGE = 100;
const NUDGES_A_STEP = 4;

/** Returns what ends it; ending twice is harmless. */
export function startCreeping(
  { clock, reach, motion, mayMove, move }: Creeping,
  direction: 1 | -1,
): () => void {
  const step = (reach.max - reach.min) / STEPS_A_RANGE;
  let taken = 0;
  let cancel = (): void => undefined;

  function go(way: number): void {
    const { target, estimated } = motion();
    if (target === null || estimated === null || Math.abs(target - estimated) > 2 * Math.max(way, step))
      return;
    const next = Math.round(target) + direction * Math.max(1, Math.round(way));
    const within = Math.min(reach.max, Math.max(reach.min, next));
    if (within === target) return;
    taken += 1;
    move(within, STEP_MS);
  }

  function creep(): void {
    if (!mayMove()) return;
    go(taken > FASTER_AFTER_STEPS ? FASTER * step : step);
    cancel = clock.after(STEP_MS, creep);
  }

  if (mayMove()) {
    go(step / NUDGES_A_STEP);
    cancel = clock.after(HOLD_AFTER_MS, creep);
  }
  return () => cancel();
}
