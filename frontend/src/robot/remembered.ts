// What this browser remembers from visit to visit: the family and nickname of each board, which of its slots hold half a group, the way to a
// robot that was chosen last, and where the servos were last sent: a guess that is offered, never a known position. Moves nothing. Where
// storage is forbidden it lasts until the page is closed.

import { createStore, type StoreApi } from 'zustand/vanilla';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import type { SlotMemory } from '#shared/robot/download.ts';
import { nameOf, type Way, type WayKind, type Device, type DeviceState } from './device.ts';
import { readText, saveText, type TextStorage, createThrottle } from '../state/storage.ts';
import type { Robot, RobotServo } from '#shared/profile/robot.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';

interface KnownBoard {
  readonly family: FamilyId;
  /** Empty where the person gave none. */
  readonly nickname: string;
}

export interface Boards {
  /** By the way's name, see `nameOf`. */
  readonly store: StoreApi<Readonly<Record<string, KnownBoard>>>;
  recall(way: BoardWay): KnownBoard | undefined;
  remember(way: BoardWay, family: FamilyId): void;
  rename(way: BoardWay, nickname: string): void;
}

type BoardWay = Pick<Way, 'kind' | 'label'>;

export const NICKNAME_LENGTH = 64;
const BOARDS_KEY = 'servodeck.boards';

export function createBoards(storage: TextStorage): Boards {
  const store = createStore(() => load(storage));

  function put(way: BoardWay, board: KnownBoard): void {
    store.setState({ [nameOf(way)]: board });
    saveText(storage, BOARDS_KEY, JSON.stringify(store.getState()));
  }

  const recall = (way: BoardWay): KnownBoard | undefined => store.getState()[nameOf(way)];

  return {
    store,
    recall,
    remember: (way, family) => put(way, { nickname: '', ...recall(way), family }),
    rename(way, nickname) {
      const known = recall(way);
      if (known !== undefined) put(way, { ...known, nickname: nickname.trim().slice(0, NICKNAME_LENGTH) });
    },
  };
}

/** Whatever else stands there was not written here and is passed over. */
function load(storage: TextStorage): Readonly<Record<string, KnownBoard>> {
  try {
    const stored: unknown = JSON.parse(storage.getItem(BOARDS_KEY) ?? '{}');
    const entries: readonly [string, unknown][] = Object.entries(stored ?? {});
    return Object.fromEntries(entries.flatMap(([name, board]) => (isKnown(board) ? [[name, board]] : [])));
  } catch {
    return {};
  }
}

function isKnown(board: unknown): board is KnownBoard {
  const { family, nickname } = (board ?? {}) as Partial<Record<keyof KnownBoard, unknown>>;
  return typeof family === 'string' && family in FAMILIES && typeof nickname === 'string';
}

const SLOTS_KEY = 'servodeck.brokenSlots';

/** Outlives a session, so that reconnecting without storage forgets nothing either. By storage: each opened page has its own. */
const visits = new WeakMap<TextStorage, Map<string, string>>();

/**
 * The board's name is read each time, when the link is there: some links learn it only by opening, forget it
 * when they close, and may find another board later.
 */
export function rememberSlots(storage: TextStorage, way: () => BoardWay): SlotMemory {
  const keyNow = (): string => `${SLOTS_KEY} ${nameOf(way())}`;
  const thisVisit = visits.get(storage) ?? new Map<string, string>();
  visits.set(storage, thisVisit);
  let key = keyNow();
  return {
    read() {
      key = keyNow();
      return slotsIn(thisVisit.get(key) ?? readText(storage, key) ?? '');
    },
    write(brokenSlots) {
      const text = brokenSlots.join(' ');
      thisVisit.set(key, text);
      saveText(storage, key, text);
    },
  };
}

/** Whatever else stands there was not written here and is passed over. */
function slotsIn(text: string): readonly number[] {
  return text.split(' ').flatMap((word) => (/^\d+$/.test(word) ? [Number(word)] : []));
}

interface LastWay {
  readonly kind: WayKind;
  readonly board: FamilyId;
}

const WAY_KEY = 'servodeck.way';
const KINDS: readonly string[] = [
  'webSerial',
  'webHid',
  'webBluetooth',
  'gateway',
  'simulated',
] satisfies WayKind[];

export function rememberWay(storage: TextStorage, { kind, board }: LastWay): void {
  saveText(storage, WAY_KEY, `${kind} ${board}`);
}

export function recallWay(storage: TextStorage): LastWay | null {
  const [kind = '', board = ''] = readText(storage, WAY_KEY)?.split(' ') ?? [];
  if (!KINDS.includes(kind) || !(board in FAMILIES)) return null;
  return { kind: kind as LastWay['kind'], board: board as FamilyId };
}

const RECONNECTS_KEY = 'servodeck.reconnects';

/** Links come back by themselves unless a person chose otherwise. */
export const recallReconnects = (storage: TextStorage): boolean =>
  readText(storage, RECONNECTS_KEY) !== 'off';

export const rememberReconnects = (storage: TextStorage, reconnects: boolean): void =>
  saveText(storage, RECONNECTS_KEY, reconnects ? 'on' : 'off');

/** By servo. */
export type Positions = Readonly<Record<number, number>>;

interface LastPose {
  /** Another family means another unit. */
  readonly family: FamilyId;
  readonly positions: Positions;
}

type Poses = Readonly<Record<string, LastPose>>;
/** By the way's name, see `nameOf` in device.ts. */
export type LastPoses = StoreApi<Poses>;

const KEY = 'servodeck.lastPoses';
/** A drag sends dozens of packets a second; storage is slow. */
const KEEP_AFTER_MS = 500;

export function createLastPoses(storage: TextStorage, device: Device): LastPoses {
  const store: LastPoses = createStore(() => loadPoses(storage));
  let latest: DeviceState | null = null;
  const robotSync = createThrottle(device.clock, KEEP_AFTER_MS, keep);

  function keep(): void {
    if (latest === null) return;
    // A group on the board continues without a packet.
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
function withPose(poses: Poses, state: DeviceState, requested: readonly ServoTarget[]): Poses {
  const name = remembered(state);
  const family = state.family.id;
  if (name === null || family === 'unknown') return poses;
  const saved = poses[name]?.family === family ? poses[name].positions : {};
  const { waitingToStart } = state.snapshot;
  // The command of a servo that still waits for its first move has not happened.
  const news = requested.filter(
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
function loadPoses(storage: TextStorage): Poses {
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
