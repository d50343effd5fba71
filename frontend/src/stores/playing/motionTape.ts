// The motion of the last two minutes, always kept: where each servo was by estimate, many times a second while any of them moves.
// Bounded: what is older goes. Knows no group.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Sample } from '#shared/actions/group/simplify.ts';
import type { Clock } from '#shared/clock.ts';
import type { Device } from '../device/device.ts';
import type { RobotStore } from '../robots/robots.ts';

export interface TapeState {
  /** On the clock; null: nothing is recorded on purpose. */
  readonly recordingSinceMs: number | null;
  /** What waits to become keys; empty: nothing does. */
  readonly taken: readonly Sample[];
}

export interface MotionTape {
  readonly store: StoreApi<TapeState>;
  record(): void;
  /** What these servos did since `record`, from the first motion to the last. */
  end(servos: readonly number[]): readonly Sample[];
  /** What every servo did, as far as the tape goes back. */
  takeThat(): readonly Sample[];
}

export interface MotionTapeOptions {
  readonly device: Device;
  readonly robots: RobotStore;
  readonly clock: Clock;
}

interface Moment {
  readonly atMs: number;
  readonly pose: ReadonlyMap<number, number>;
}

const TAPE_MS = 120_000;
/** Finer than a hand, and as fine as most boards step. */
const SAMPLE_MS = 40;

export function createMotionTape({ device, robots, clock }: MotionTapeOptions): MotionTape {
  const store = createStore<TapeState>(() => ({ recordingSinceMs: null, taken: [] }));
  let moments: Moment[] = [];
  let last: Moment | null = null;
  let owner = robots.current().id;

  function poseNow(): ReadonlyMap<number, number> {
    const motion = device.motions();
    const known = robots.current().robot.servos.flatMap(({ servo }): [number, number][] => {
      const { estimated } = motion(servo);
      return estimated === null ? [] : [[servo, Math.round(estimated)]];
    });
    return new Map(known);
  }

  /** What stood still is kept only where a motion begins. */
  function sample(): void {
    const now = { atMs: clock.now(), pose: poseNow() };
    if (last !== null && !samePose(last.pose, now.pose)) {
      if (moments.at(-1) !== last) moments.push(last);
      moments.push(now);
    }
    last = now;
    const gone = moments.findIndex(({ atMs }) => atMs >= now.atMs - TAPE_MS);
    if (gone !== 0 && moments.length > 0) moments = gone === -1 ? [] : moments.slice(gone);
    clock.after(SAMPLE_MS, sample);
  }
  sample();

  robots.store.subscribe(() => {
    const { id } = robots.current();
    if (id === owner) return;
    // The positions of another robot say nothing of this one.
    [owner, moments, last] = [id, [], null];
    store.setState({ recordingSinceMs: null });
  });

  function since(fromMs: number, servos?: readonly number[]): readonly Sample[] {
    return moments
      .filter(({ atMs }) => atMs >= fromMs)
      .flatMap(({ atMs, pose }) =>
        [...pose]
          .filter(([servo]) => servos?.includes(servo) ?? true)
          .map(([servo, position]) => ({ atMs, servo, position })),
      );
  }

  return {
    store,
    record: () => store.setState({ recordingSinceMs: clock.now() }),
    end(servos) {
      const { recordingSinceMs } = store.getState();
      store.setState({ recordingSinceMs: null });
      return recordingSinceMs === null ? [] : since(recordingSinceMs - SAMPLE_MS, servos);
    },
    takeThat: () => since(-Infinity),
  };
}

/** A servo that becomes known did not move there. */
function samePose(before: Moment['pose'], after: Moment['pose']): boolean {
  return [...after].every(([servo, position]) => (before.get(servo) ?? position) === position);
}
