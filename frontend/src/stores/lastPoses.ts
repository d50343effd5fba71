// Where the servos of each board were last sent, kept for the next visit: a guess that is offered, never a position that is
// known. Hears the device and knows storage; moves nothing. A simulated board begins anew each time: nothing of it is kept.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Robot, RobotServo } from '#shared/actions/robot/robot.ts';
import { FAMILIES, type FamilyId } from '#shared/protocol/families.ts';
import { nameOf } from './boards.ts';
import type { Device, DeviceState } from './device.ts';
import type { TextStorage } from './document.ts';
import type { Stand } from './servoView.ts';
import { createSoon } from './soon.ts';

export interface LastPose {
  /** Another family means another unit. */
  readonly family: FamilyId;
  readonly positions: Stand;
}

type Poses = Readonly<Record<string, LastPose>>;
/** By the way's name, see `nameOf` in boards.ts. */
export type LastPoses = StoreApi<Poses>;

const KEY = 'servodeck.lastPoses';
/** A drag changes targets at each frame; storage is slow. */
const KEEP_AFTER_MS = 500;

export function createLastPoses(storage: TextStorage, device: Device): LastPoses {
  const store: LastPoses = createStore(() => load(storage));
  let latest: DeviceState | null = null;
  const keeping = createSoon(device.clock, KEEP_AFTER_MS, keep);

  function keep(): void {
    if (latest === null) return;
    store.setState(withPoseOf(latest, store.getState()), true);
    if (latest.snapshot.waitingToStart.length > 0) keeping.ask();
    try {
      storage.setItem(KEY, JSON.stringify(store.getState()));
    } catch {
      // This visit still knows.
    }
  }

  device.store.subscribe((state, before) => {
    if (remembered(state) !== null) latest = state;
    else if (latest !== null) {
      // The link ended, and with it what was known.
      keep();
      latest = null;
    }
    if (state.targets !== before.targets) keeping.ask();
  });
  return store;
}

function withPoseOf(state: DeviceState, poses: Poses): Poses {
  const name = remembered(state);
  const family = state.family.id;
  const sent = sentOf(state);
  if (name === null || family === 'unknown' || Object.keys(sent).length === 0) return poses;
  const known = poses[name];
  return {
    ...poses,
    [name]: { family, positions: { ...(known?.family === family && known.positions), ...sent } },
  };
}

/** Where this servo may stand, or null where that is known better, or where the robot must not go now. */
export function guessOf(poses: Poses, state: DeviceState, { servo, min, max }: RobotServo): number | null {
  const name = remembered(state);
  if (name === null || state.targets[servo] !== undefined || servo in state.snapshot.reported) return null;
  const pose = poses[name];
  const position = pose?.family === state.family.id ? pose.positions[servo] : undefined;
  return position === undefined || position < min || position > max ? null : position;
}

/** Of every servo there is a guess for. */
export function guessesOf(poses: Poses, state: DeviceState, { servos }: Robot): Stand {
  const guesses: Record<number, number> = {};
  for (const servo of servos) {
    const guess = guessOf(poses, state, servo);
    if (guess !== null) guesses[servo.servo] = guess;
  }
  return guesses;
}

/** What its pose is kept under; null where none is kept. */
function remembered({ way, snapshot }: DeviceState): string | null {
  return way === null || way.isSimulated || snapshot.link.status !== 'ready' ? null : nameOf(way);
}

/** What was asked of a servo that still waits for its first move has not happened. */
function sentOf({ targets, snapshot }: DeviceState): Stand {
  const waiting = new Set(snapshot.waitingToStart);
  return Object.fromEntries(Object.entries(targets).filter(([servo]) => !waiting.has(Number(servo))));
}

/** Whatever else stands there was not written here and is passed over. */
function load(storage: TextStorage): Poses {
  try {
    const stored: unknown = JSON.parse(storage.getItem(KEY) ?? '{}');
    const entries: readonly [string, unknown][] = Object.entries(stored ?? {});
    return Object.fromEntries(entries.flatMap(([name, pose]) => (isPose(pose) ? [[name, pose]] : [])));
  } catch {
    return {};
  }
}

function isPose(pose: unknown): pose is LastPose {
  const { family, positions } = (pose ?? {}) as Partial<Record<keyof LastPose, unknown>>;
  if (typeof family !== 'string' || !(family in FAMILIES)) return false;
  if (typeof positions !== 'object' || positions === null || Array.isArray(positions)) return false;
  return Object.values(positions).every((position) => Number.isInteger(position));
}
