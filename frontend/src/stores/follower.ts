// Takes the robot to where the group is at an instant, by the ordinary road: limits, and gently where it comes from elsewhere. Knows
// no playing.

import { poseAtMs, tracksOf } from '#shared/actions/group/tracks.ts';
import type { Device } from './device.ts';
import type { Document } from './document.ts';
import { GENTLE_MOVE_MS } from './moveTime.ts';
import { startHindrance } from './readiness.ts';

export interface Follower {
  /** From now on the robot follows: it goes to where it belongs gently. */
  begin(): void;
  /** To be called while the page is drawn. Nothing happens while something else moves the robot. */
  follow(atMs: number): void;
  /** Once; as fast as `durationMs` where it stands at `fromMs` of the group. */
  go(atMs: number, durationMs: number, fromMs: number): void;
}

type Pose = ReadonlyMap<number, number>;

/** A step of a few milliseconds would be a jerk. */
const LEAST_STEP_MS = 200;
/** A servo so near is where it was told to be. */
const NEAR_UNITS = 10;

export interface FollowerOptions {
  readonly device: Device;
  readonly document: Document;
}

export function createFollower({ device, document }: FollowerOptions): Follower {
  const { clock } = device;
  let told: Pose | null = null;
  let gentleUntilMs = 0;

  function poseAt(atMs: number): Pose {
    const pose = poseAtMs(tracksOf(document.store.getState().present), atMs);
    return new Map([...pose].map(([servo, position]) => [servo, Math.round(position)]));
  }

  function isAt(atMs: number): boolean {
    return [...poseAt(atMs)].every(([servo, position]) => {
      const { estimated } = device.motion(servo);
      return estimated !== null && Math.abs(estimated - position) <= NEAR_UNITS;
    });
  }

  function mayFollow(): boolean {
    const { family, snapshot } = device.store.getState();
    return startHindrance(snapshot) === null && document.store.getState().present.unit === family.unit;
  }

  function move(pose: readonly (readonly [number, number])[], durationMs: number | 'hand'): void {
    device.move(
      pose.map(([servo, position]) => ({ servo, position })),
      durationMs,
    );
  }

  return {
    begin: () => (told = null),
    follow(atMs) {
      if (!mayFollow()) return;
      const pose = poseAt(atMs);
      const changed = [...pose].filter(([servo, position]) => told?.get(servo) !== position);
      if (changed.length === 0) return;
      if (told === null) gentleUntilMs = clock.now() + GENTLE_MOVE_MS;
      told = pose;
      const gentleMs = gentleUntilMs - clock.now();
      move(changed, gentleMs > 0 ? gentleMs : 'hand');
    },
    go(atMs, durationMs, fromMs) {
      move([...poseAt(atMs)], isAt(fromMs) ? Math.max(durationMs, LEAST_STEP_MS) : GENTLE_MOVE_MS);
    },
  };
}
