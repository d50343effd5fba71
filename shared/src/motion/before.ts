// An estimate taken over from somebody who was there before: whose packets moved the robot, and who says where they have
// taken it. Knows no link; a servo that is not named is of unknown place.

import type { Family } from '../codec/families.ts';
import { afterOrder, runningUnknown, type Motion } from './model.ts';
import { boardDurationMs, type Track } from './tracks.ts';

/** Begun so long ago (below 0: not yet); `from` is null where nobody knows where it began. */
export interface WayBefore {
  readonly servo: number;
  readonly from: number | null;
  readonly to: number;
  readonly begunMsAgo: number;
  readonly durationMs: number;
}

/** `runSlot`: the group that may run, whose frames nobody told. `released`: without torque, hands may have turned them. */
export interface MotionBefore {
  readonly ways: readonly WayBefore[];
  readonly runSlot: number | null;
  readonly released: readonly number[];
}

/** In place of what was believed of the servos. */
export function takenOver(motion: Motion, before: MotionBefore, nowMs: number, family: Family): Motion {
  const readings = afterOrder(motion.readings, { kind: 'release', servos: before.released }, true);
  if (before.runSlot !== null) return runningUnknown({ ...motion, readings }, before.runSlot);
  const tracks = before.ways.map((way) => [way.servo, trackOf(way, nowMs, family)] as const);
  return { ...motion, readings, tracks: new Map(tracks), run: null };
}

function trackOf({ from, to, begunMsAgo, durationMs }: WayBefore, nowMs: number, family: Family): Track {
  const startMs = nowMs - begunMsAgo;
  return {
    ...{ from, to, startMs, durationMs: boardDurationMs(durationMs, family) },
    ...{ fromLeeway: 0, toLeeway: 0 },
  };
}
