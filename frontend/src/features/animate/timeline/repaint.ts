// What of the tracks has to be painted anew: after an edit that gave keys other positions the place of these, else all of it. Pure.

import { isPlacedAlike, type Key } from '#shared/group/tracks.ts';
import type { GroupFrame } from '#shared/group/group.ts';
import { keysInRow, type PlacedRow } from './rows.ts';
import type { Scene } from './scene.ts';
import { xOf } from './timeScale.ts';

export interface Stretch {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

export const wholeOf = ({ widthPx, heightPx }: Scene): Stretch => ({
  ...{ left: 0, right: widthPx, top: 0, bottom: heightPx },
});

/** A key, and the frame around it, reach so far beside their place and into the next row. */
const BESIDE_PX = 12;
const OVER_PX = 4;

/** What holds all keys that are others, with the ways to and from them; null where anything else is another, or nothing. */
export function changedStretch(before: Scene, after: Scene): Stretch | null {
  if (!isSameButKeys(before, after)) return null;
  const changed = after.rows.flatMap((placed) => {
    const keys = keysInRow(placed.row, after.times);
    const [from, to] = differingIn(keysInRow(placed.row, before.times), keys);
    return to < 0 ? [] : [{ ...placed, ...waysBeside(after, keys, from, to) }];
  });
  const [first, last] = [changed[0], changed.at(-1)];
  if (first === undefined || last === undefined) return null;
  return {
    left: Math.min(...changed.map(({ left }) => left)) - BESIDE_PX,
    right: Math.max(...changed.map(({ right }) => right)) + BESIDE_PX,
    top: first.top - OVER_PX,
    bottom: last.top + last.height + OVER_PX,
  };
}

/** The first and the last place at which they differ, -1 where they do nowhere. */
function differingIn(some: readonly Key[], others: readonly Key[]): readonly [number, number] {
  if (some === others) return [-1, -1];
  const differs = (key: Key, index: number): boolean => key !== some[index];
  return [others.findIndex(differs), others.findLastIndex(differs)];
}

/** From the key before to the key behind. A servo waits for its first key and stays at its last. */
function waysBeside({ state, widthPx }: Scene, keys: readonly Key[], from: number, to: number) {
  const [before, behind] = [keys[from - 1], keys[to + 1]];
  return {
    left: before === undefined ? 0 : xOf(state.time, before.atMs),
    right: behind === undefined ? widthPx : xOf(state.time, behind.atMs),
  };
}

export const isWithin = ({ top, height }: PlacedRow, stretch: Stretch): boolean =>
  top < stretch.bottom && top + height > stretch.top;

const STATE = ['selected', 'marker', 'range', 'widthPx', 'heightPx'] as const;

function isSameButKeys(before: Scene, after: Scene): boolean {
  return (
    before.family === after.family &&
    before.markers === after.markers &&
    before.blocks.length + after.blocks.length === 0 && // one covers more than the key that changed
    before.compiled === after.compiled &&
    before.collisions === after.collisions &&
    STATE.every((name) => before.state[name] === after.state[name]) &&
    isSameRecord(before.state.time, after.state.time) &&
    isSameRecord(before.state.cursor, after.state.cursor) &&
    isSameRecord(before.sizes, after.sizes) &&
    isSameSet(before.held, after.held) &&
    isSameSet(before.muted, after.muted) &&
    isSameList(before.rows, after.rows, isSameRow) &&
    isSameList(before.times.frames, after.times.frames, isSameHead)
  );
}

const isSameRow = (one: PlacedRow, other: PlacedRow): boolean =>
  one.row.id === other.row.id &&
  one.row.servo === other.row.servo &&
  one.top === other.top &&
  one.height === other.height;

const isSameHead = (one: GroupFrame, other: GroupFrame): boolean =>
  one === other || (isPlacedAlike(one, other) && one.colour === other.colour && one.note === other.note);

function isSameList<T>(some: readonly T[], others: readonly T[], isSame: (one: T, other: T) => boolean) {
  return (
    some.length === others.length &&
    some.every((one, index) => {
      const other = others[index];
      return other !== undefined && isSame(one, other);
    })
  );
}

const isSameRecord = <T extends object>(one: T, other: T): boolean =>
  one === other || (Object.keys(one) as (keyof T)[]).every((key) => one[key] === other[key]);

const isSameSet = (one: ReadonlySet<string>, other: ReadonlySet<string>): boolean =>
  one.size === other.size && [...one].every((id) => other.has(id));
