// Where the servos of each board were last sent, stored for the next visit: a guess that is offered, never a position that is
// known. Hears the device and knows storage; moves nothing. A simulated board begins anew each time: nothing of it is stored.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Robot, RobotServo } from '#shared/profile/robot.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import { nameOf } from './remembered.ts';
import type { Device, DeviceState } from './device.ts';
import { createThrottle, saveText, type TextStorage } from '../state/storage.ts';

/** By servo. */
export type Positions = Readonly<Record<number, number>>;

export interface LastPose {
  /** Another family means another unit. */
  readonly family: FamilyId;
  readonly positions: Positions;
}

type Poses = Readonly<Record<string, LastPose>>;
/** By the way's name, see `nameOf` in remembered.ts. */
export type LastPoses = StoreApi<Poses>;

const KEY = 'servodeck.lastPoses';
/** A drag sends dozens of packets a second; storage is slow. */
const KEEP_AFTER_MS = 500;

export function createLastPoses(storage: TextStorage, device: Device): LastPoses {
  const store: LastPoses = createStore(() => load(storage));
  let latest: DeviceState | null = null;
  const robotSync = createThrottle(device.clock, KEEP_AFTER_MS, keep);

  function keep(): void {
    if (latest === null) return;
    // A group on the board goes on without a packet.
    if (latest.isMoving || latest.snapshot.waitingToStart.length > 0) robotSync.request();
    const before = store.getState();
    const after = withPose(before, latest, device.pose());
    if (after === before) return;
    store.setState(after, true);
    saveText(storage, KEY, JSON.stringify(after));
  }

  device.store.subscribe((state, before) => {
    if (remembered(state) !== null) latest = state;
    else if (latest !== null) {
      // The link ends, and with it what is known.
      keep();
      latest = null;
    }
    if (state.known !== before.known || state.isMoving !== before.isMoving) robotSync.request();
  });
  device.traffic.store.subscribe(robotSync.request);
  return store;
}

/** The very same poses where they hold that already. */
function withPose(poses: Poses, state: DeviceState, asked: readonly ServoTarget[]): Poses {
  const name = remembered(state);
  const family = state.family.id;
  if (name === null || family === 'unknown') return poses;
  const saved = poses[name]?.family === family ? poses[name].positions : {};
  const { waitingToStart } = state.snapshot;
  // What was asked of a servo that still waits for its first move has not happened.
  const news = asked.filter(
    ({ servo, position }) => !waitingToStart.includes(servo) && saved[servo] !== position,
  );
  if (news.length === 0) return poses;
  const positions = { ...saved, ...Object.fromEntries(news.map(({ servo, position }) => [servo, position])) };
  return { ...poses, [name]: { family, positions } };
}

/** Where this servo may stand, or null where that is known better, or where the robot must not go now. */
export function guessOf(poses: Poses, state: DeviceState, { servo, min, max }: RobotServo): number | null {
  const name = remembered(state);
  if (name === null || state.known.includes(servo) || servo in state.snapshot.reported) return null;
  const pose = poses[name];
  const position = pose?.family === state.family.id ? pose.positions[servo] : undefined;
  return position === undefined || position < min || position > max ? null : position;
}

/** Of every servo there is a guess for. */
export function guessesOf(poses: Poses, state: DeviceState, { servos }: Robot): Positions {
  const guesses: Record<number, number> = {};
  for (const servo of servos) {
    const guess = guessOf(poses, state, servo);
    if (guess !== null) guesses[servo.servo] = guess;
  }
  return guesses;
}

/** What its pose is stored under; null where none is stored. */
function remembered({ way, snapshot }: DeviceState): string | null {
  return way === null || way.isSimulated || snapshot.link.status !== 'ready' ? null : nameOf(way);
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
