// Takes the robot along with a pose that changes under a person's hand, by the ordinary road: limits, and gently where it comes from
// elsewhere. Knows neither playing nor where the pose comes from.

import type { Device } from './device.ts';
import { GENTLE_MOVE_MS } from './moves.ts';
import { startHindrance } from './readiness.ts';

export type FollowedPose = ReadonlyMap<number, number>;

export interface Follower {
  /** From now on the robot follows: it goes to where it belongs gently. */
  begin(): void;
  /** Nothing happens while something else moves the robot. */
  follow(pose: FollowedPose): void;
  /** Once; in `durationMs` where it stands at `from`. */
  go(pose: FollowedPose, durationMs: number, from: FollowedPose): void;
}

/** A step of a few milliseconds would be a jerk. */
const LEAST_STEP_MS = 200;
/** A servo so near has reached its target. */
const NEAR_UNITS = 10;

export function createFollower(device: Device): Follower {
  const { clock } = device;
  let sent: FollowedPose | null = null;
  let gentleUntilMs = 0;

  function isAt(pose: FollowedPose): boolean {
    return [...pose].every(([servo, position]) => {
      const { estimated } = device.motion(servo);
      return estimated !== null && Math.abs(estimated - position) <= NEAR_UNITS;
    });
  }

  function move(pose: readonly (readonly [number, number])[], durationMs: number | 'hand'): void {
    device.move(
      pose.map(([servo, position]) => ({ servo, position })),
      durationMs,
    );
  }

  return {
    begin: () => (sent = null),
    follow(pose) {
      if (startHindrance(device.store.getState().snapshot) !== null) return;
      const changed = [...pose].filter(([servo, position]) => sent?.get(servo) !== position);
      if (changed.length === 0) return;
      if (sent === null) gentleUntilMs = clock.now() + GENTLE_MOVE_MS;
      sent = pose;
      const gentleMs = Math.ceil(gentleUntilMs - clock.now());
      move(changed, gentleMs > 0 ? gentleMs : 'hand');
    },
    go(pose, durationMs, from) {
      sent = pose;
      move([...pose], isAt(from) ? Math.max(durationMs, LEAST_STEP_MS) : GENTLE_MOVE_MS);
    },
  };
}
