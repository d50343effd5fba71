// An estimate taken over from somebody who was there before: whose packets moved the robot, and who says where they have
// taken it. Knows no link; a servo that is not named is of unknown place.

import type { Family } from '../codec/families.ts';
import { afterOrder, afterPositions, runningUnknown, type Motion } from './model.ts';
import { boardDurationMs, type Track } from './tracks.ts';

/** Begun so long ago (below 0: not yet); `from` is null where nobody knows where it began. */
export interface WayBefore {
  readonly servo: number;
  readonly from: number | null;
  readonly to: number;
  readonly begunMsAgo: number;
  readonly durationMs: number;
}

/** Where the board said that a servo stood; `isCurrent`: as far as anybody can tell it stands there still. */
export interface PositionBefore {
  readonly servo: number;
  readonly position: number;
  readonly atMs: number;
  readonly isCurrent: boolean;
}

/** `runSlot`: the group that may run, whose frames nobody told. `released`: without torque, hands may have turned them. */
export interface MotionBefore {
  readonly ways: readonly WayBefore[];
  readonly runSlot: number | null;
  readonly released: readonly number[];
  readonly reported: readonly PositionBefore[];
}

/** In place of what was believed of the servos. */
export function takenOver(motion: Motion, before: MotionBefore, nowMs: number, family: Family): Motion {
  const released = afterOrder(motion.readings, { kind: 'release', servos: before.released }, true);
  const readings = afterPositions(
    released,
    before.reported.filter(({ isCurrent }) => isCurrent),
  );
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
