// An action group seen servo by servo: the keys of each, how it comes into them, and where it is between them. Numbers stay
// unrounded; what a board makes of them is compile.ts. Knows no board.

import { curveOf, sameEasing, turnsOf, type Easing } from './curves.ts';
import { easingOf, type ActionGroup, type GroupFrame } from './group.ts';
import type { Frame } from '../codec/commands.ts';

/** A key's name in the document. */
export interface KeyRef {
  readonly frameId: number;
  readonly servo: number;
}

interface PlacedKey extends KeyRef {
  /** When the servo is there, counted from the beginning of the group. */
  readonly atMs: number;
  readonly position: number;
}

export interface Key extends PlacedKey {
  /** How it comes here from its key before. */
  readonly easing: Easing;
}

/** One servo's keys in the order of time, at least one. */
export interface Track {
  readonly servo: number;
  readonly keys: readonly Key[];
}

/** In ascending servo order. */
export type Tracks = ReadonlyMap<number, Track>;

const NO_TRACKS: Tracks = new Map();

/** When each frame is done. */
export function frameEnds(frames: readonly Frame[]): readonly number[] {
  let atMs = 0;
  return frames.map(({ durationMs }) => (atMs += durationMs));
}

/** What is the same as in `before` at the same place is the very same: key objects, and tracks of nothing but such keys. */
export function tracksOf({ frames }: Pick<ActionGroup, 'frames'>, before = NO_TRACKS): Tracks {
  const keys = new Map<number, Key[]>();
  let atMs = 0;
  for (const frame of frames) {
    atMs += frame.durationMs;
    addKeys(keys, frame, atMs, before);
  }
  const servos = [...keys].sort(([one], [other]) => one - other);
  return new Map(servos.map(([servo, own]) => [servo, trackOf(servo, own, before.get(servo))]));
}

/**
 * The tracks of frames that are placed like those `before`; null where more than a few positions are others. What an arrow key does
 * to a key need not have thousands of others read.
 */
export function repositioned(
  frames: readonly GroupFrame[],
  before: {
    readonly frames: readonly GroupFrame[];
    readonly ends: readonly number[];
    readonly tracks: Tracks;
  },
): Tracks | null {
  const moved: PlacedKey[] = [];
  for (const [index, frame] of frames.entries()) {
    const [was, atMs] = [before.frames[index], before.ends[index]];
    if (was === frame || was === undefined || atMs === undefined) continue;
    for (const [place, target] of frame.targets.entries())
      if (target.position !== was.targets[place]?.position)
        moved.push({ ...target, frameId: frame.id, atMs });
    if (moved.length > FEW_KEYS) return null;
  }
  const tracks = new Map(before.tracks);
  for (const key of moved) reposition(tracks, key);
  return tracks;
}

/** Each of them has its servo's keys copied. */
const FEW_KEYS = 32;

/** The same but for positions, and what is said of them. */
export function arePlacedAlike(some: readonly GroupFrame[], others: readonly GroupFrame[]): boolean {
  return (
    some.length === others.length &&
    some.every((one, index) => {
      const other = others[index];
      return one === other || (other !== undefined && isPlacedAlike(one, other));
    })
  );
}

/** The same but for positions, and what is said of it. */
export function isPlacedAlike(one: GroupFrame, other: GroupFrame): boolean {
  return (
    one.id === other.id &&
    one.durationMs === other.durationMs &&
    one.easing === other.easing &&
    one.targets.length === other.targets.length &&
    one.targets.every(
      ({ servo, easing }, index) =>
        servo === other.targets[index]?.servo && easing === other.targets[index].easing,
    )
  );
}

function reposition(tracks: Map<number, Track>, { frameId, servo, atMs, position }: PlacedKey): void {
  const keys = tracks.get(servo)?.keys ?? [];
  const index = placeOfKey(keys, frameId, atMs);
  const key = keys[index];
  if (key !== undefined) tracks.set(servo, { servo, keys: keys.with(index, { ...key, position }) });
}

/** -1 where the frame, which ends at `atMs`, has no key of this servo. */
function placeOfKey(keys: readonly Key[], frameId: number, atMs: number): number {
  let place = keysUntil(keys, atMs) - 1;
  while (place >= 0 && keys[place]?.frameId !== frameId) place -= 1; // several may be at one instant
  return place;
}

/** The key that the servo has in the frame, which ends at `atMs`. */
export function keyIn(tracks: Tracks, { frameId, servo }: KeyRef, atMs: number): Key | undefined {
  const keys = tracks.get(servo)?.keys ?? [];
  return keys[placeOfKey(keys, frameId, atMs)];
}

function addKeys(keys: Map<number, Key[]>, frame: GroupFrame, atMs: number, before: Tracks): void {
  const frameId = frame.id;
  for (const target of frame.targets) {
    const { servo, position } = target;
    const easing = easingOf(target, frame);
    const own = keys.get(servo) ?? [];
    if (own.length === 0) keys.set(servo, own);
    const there = before.get(servo)?.keys[own.length];
    const isSame =
      there?.frameId === frameId &&
      there.atMs === atMs &&
      there.position === position &&
      sameEasing(there.easing, easing);
    own.push(isSame ? there : { frameId, servo, atMs, position, easing });
  }
}

function trackOf(servo: number, keys: readonly Key[], before: Track | undefined): Track {
  const isSame =
    before?.keys.length === keys.length && before.keys.every((key, index) => key === keys[index]);
  return isSame ? before : { servo, keys };
}

/**
 * Null before the first key, unless it is known where the servo stands when the group begins. Of keys at the same instant
 * the last one counts.
 */
export function positionAt({ keys }: Track, atMs: number, startPosition?: number): number | null {
  const reached = keysUntil(keys, atMs);
  const from = keys[reached - 1] ?? startOf(startPosition);
  const to = keys[reached];
  if (from === null || to === undefined) return from?.position ?? null;
  const share = (atMs - from.atMs) / (to.atMs - from.atMs);
  return from.position + (to.position - from.position) * curveOf(to.easing).at(Math.max(0, share));
}

/** The lowest and the highest position, where its curves swing beyond its keys too. */
export function extentOf({ keys }: Track): readonly [lowest: number, highest: number] {
  const positions = keys.flatMap(({ position, easing }, index) => {
    const from = keys[index - 1]?.position ?? position;
    return [position, ...turnsOf(easing).map((share) => from + share * (position - from))];
  });
  return [Math.min(...positions), Math.max(...positions)];
}

const startOf = (position: number | undefined) => (position === undefined ? null : { atMs: 0, position });

/** How many keys have come by then. */
export function keysUntil(keys: readonly Key[], atMs: number): number {
  let low = 0;
  let high = keys.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((keys[middle]?.atMs ?? Infinity) <= atMs) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Where every servo is that anything is known of; `start` is where they stand when the group begins. */
export function poseAtMs(
  tracks: Tracks,
  atMs: number,
  start: ReadonlyMap<number, number> = new Map(),
): ReadonlyMap<number, number> {
  const pose = new Map(start);
  for (const [servo, track] of tracks) {
    const position = positionAt(track, atMs, start.get(servo));
    if (position !== null) pose.set(servo, position);
  }
  return pose;
}

/**
 * The keys of these servos at these times, by name; what is not there is left out. Mostly they are wanted in the order of time:
 * then the next one stands right behind the one found last.
 */
export function keysAt(tracks: Tracks, wanted: readonly Pick<Key, 'servo' | 'atMs'>[]): readonly KeyRef[] {
  const found: KeyRef[] = [];
  const ahead = new Map<number, number>();
  for (const { servo, atMs } of wanted) {
    const keys = tracks.get(servo)?.keys ?? [];
    const next = ahead.get(servo) ?? 0;
    const isNext = keys[next]?.atMs === atMs && keys[next + 1]?.atMs !== atMs;
    const place = isNext ? next : keysUntil(keys, atMs) - 1;
    const key = keys[place];
    if (key?.atMs === atMs) found.push({ frameId: key.frameId, servo });
    ahead.set(servo, place + 1);
  }
  return found;
}
