// The motion of the last two minutes, always recorded: where each servo was by estimate, many times a second while any of them moves.
// Bounded: what is older goes. Knows no group.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Sample } from '#shared/group/simplify.ts';
import type { Clock } from '#shared/clock.ts';
import type { Device } from '../../../robot/device.ts';
import type { RobotStore } from '../../profiles/robots.ts';

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
  /** What these servos did from then until now, where they stood at both ends included; empty: none of them moved. */
  since(fromMs: number, servos: readonly number[]): readonly Sample[];
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

  /** What stood still is recorded only where a motion begins. */
  function sample(): void {
    const now = { atMs: clock.now(), pose: poseNow() };
    if (last !== null && !samePose(last.pose, now.pose)) {
      if (moments.at(-1) !== last) moments.push(last);
      moments.push(now);
    }
    last = now;
    const gone = moments.findIndex(({ atMs }) => atMs >= now.atMs - TAPE_MS);
    if (gone !== 0 && moments.length > 0) moments = gone === -1 ? [] : moments.slice(gone);
  }

  function keepSampling(): void {
    sample();
    clock.after(SAMPLE_MS, keepSampling);
  }
  keepSampling();

  robots.store.subscribe(() => {
    const { id } = robots.current();
    if (id === owner) return;
    // The positions of another robot say nothing of this one.
    [owner, moments, last] = [id, [], null];
    store.setState({ recordingSinceMs: null });
  });

  return {
    store,
    record() {
      sample();
      store.setState({ recordingSinceMs: clock.now() });
    },
    end(servos) {
      const { recordingSinceMs } = store.getState();
      store.setState({ recordingSinceMs: null });
      if (recordingSinceMs === null) return [];
      const own = moments.filter(({ atMs }) => atMs >= recordingSinceMs);
      return samplesOf(fromFirstMotion(own)).filter(({ servo }) => servos.includes(servo));
    },
    since(sinceMs, servos) {
      sample();
      const nowMs = clock.now();
      const fromMs = Math.max(sinceMs, nowMs - TAPE_MS);
      const during = moments.filter(({ atMs }) => atMs > fromMs);
      const atBegin = moments.findLast(({ atMs }) => atMs <= fromMs) ?? during[0];
      if (atBegin === undefined || last === null) return [];
      const whole = [{ ...atBegin, atMs: fromMs }, ...during, { ...last, atMs: nowMs }];
      const own = samplesOf(whole).filter(({ servo }) => servos.includes(servo));
      return servos.some((servo) => hasMoved(own, servo)) ? own : [];
    },
    takeThat: () => samplesOf(moments),
  };
}

const samplesOf = (moments: readonly Moment[]): readonly Sample[] =>
  moments.flatMap(({ atMs, pose }) => [...pose].map(([servo, position]) => ({ atMs, servo, position })));

function hasMoved(samples: readonly Sample[], servo: number): boolean {
  const own = samples.filter((one) => one.servo === servo);
  return own.some(({ position }) => position !== own[0]?.position);
}

function fromFirstMotion(moments: readonly Moment[]): readonly Moment[] {
  const first = moments.findIndex(({ pose }, index) => {
    const next = moments[index + 1];
    return next !== undefined && !samePose(pose, next.pose);
  });
  return first === -1 ? [] : moments.slice(first);
}

/** A servo that becomes known did not move there. */
function samePose(before: Moment['pose'], after: Moment['pose']): boolean {
  return [...after].every(([servo, position]) => (before.get(servo) ?? position) === position);
}
