// Everything that is on the lanes now, with its geometry: what painting and hitting have in common. Pure.

import type { Marker } from '#shared/actions/group/group.ts';
import type { Key } from '#shared/actions/group/tracks.ts';
import { positionRange, type Family, type Range } from '#shared/protocol/families.ts';
import { isHeld, isSilent } from '../stores/servoView.ts';
import { ALL_ROW, type TimelineState } from '../stores/timeline.ts';
import type { GroupTimes } from './groupTimes.ts';
import type { Desk } from './desk.ts';
import { placedRows, seenRows, type PlacedRow, type Row } from './rows.ts';
import { topOfAll, topOfRows, type Sizes } from './sizes.ts';

export interface Scene {
  readonly state: TimelineState;
  readonly times: GroupTimes;
  readonly markers: readonly Marker[];
  readonly family: Family;
  readonly sizes: Sizes;
  /** The row of all servos and those that scroll, each where it is on the lanes. */
  readonly all: PlacedRow;
  readonly rows: readonly PlacedRow[];
  readonly widthPx: number;
  readonly heightPx: number;
  /** Rows whose keys cannot be changed, and those that move nothing. */
  readonly held: ReadonlySet<string>;
  readonly muted: ReadonlySet<string>;
}

export function sceneOf(desk: Desk, sizes: Sizes): Scene {
  const { state, times, rows, group, family, servoView } = desk;
  const [first, ...rest] = rows;
  const all = first ?? { id: ALL_ROW, kind: 'all', servos: [], name: '', servo: null };
  const isOf = (test: (servo: number) => boolean): ReadonlySet<string> =>
    new Set(rows.filter((row) => row.kind === 'servo' && row.servos.some(test)).map(({ id }) => id));
  return {
    ...{ state, times, family, sizes, markers: group.markers },
    ...{ widthPx: state.widthPx, heightPx: state.heightPx },
    all: placedAll(all, sizes),
    rows: rowsInSight(placedRows(rest, sizes), state.scrollTop, state.heightPx, sizes),
    held: isOf((servo) => isHeld(servoView, servo)),
    muted: isOf((servo) => isSilent(servoView, servo)),
  };
}

/** `placed`: the rows that scroll, from 0 on. */
function rowsInSight(
  placed: readonly PlacedRow[],
  scrollTop: number,
  heightPx: number,
  sizes: Sizes,
): readonly PlacedRow[] {
  const top = topOfRows(sizes);
  return seenRows(placed, scrollTop, heightPx - top).map((one) => ({
    ...one,
    top: one.top - scrollTop + top,
  }));
}

const placedAll = (row: Row, sizes: Sizes): PlacedRow => ({
  ...{ row, top: topOfAll(sizes), height: sizes.summary },
});

const INSET_PX = 7;

/** What the row's height stands for. */
function rangeOfRow({ servo, servos }: Row, family: Family): Range {
  return servo ?? positionRange(family, servos[0] ?? 0);
}

export function keyY({ row, top, height }: PlacedRow, position: number, family: Family): number {
  if (row.kind !== 'servo') return top + height / 2;
  const { min, max } = rangeOfRow(row, family);
  const share = Math.min(1, Math.max(0, (position - min) / (max - min)));
  return top + INSET_PX + (1 - share) * (height - 2 * INSET_PX);
}

/** In rows of several servos one for each frame that has a key of any. */
export function keysInRow({ row }: PlacedRow, times: GroupTimes): readonly Key[] {
  const [only] = row.servos;
  if (row.kind === 'servo') return times.tracks.get(only ?? -1)?.keys ?? [];
  return summaryKeys(row, times);
}

const summaries = new WeakMap<GroupTimes, Map<string, readonly Key[]>>();

function summaryKeys(row: Row, times: GroupTimes): readonly Key[] {
  const known = summaries.get(times) ?? new Map<string, readonly Key[]>();
  summaries.set(times, known);
  const name = `${row.id} ${row.servos.join(' ')}`;
  const before = known.get(name);
  if (before !== undefined) return before;
  const servos = new Set(row.servos);
  let atMs = 0;
  const keys = times.frames.flatMap(({ id: frameId, durationMs, targets, easing }) => {
    atMs += durationMs;
    const isIn = row.kind === 'all' || targets.some(({ servo }) => servos.has(servo));
    return isIn ? [{ frameId, servo: -1, atMs, position: 0, easing }] : [];
  });
  known.set(name, keys);
  return keys;
}

/** First and last place in a list in the order of time that lies within, with one more on each side. */
export function within(
  keys: readonly { readonly atMs: number }[],
  fromMs: number,
  toMs: number,
): readonly [number, number] {
  return [Math.max(0, firstFrom(keys, fromMs) - 1), Math.min(keys.length, firstFrom(keys, toMs) + 1)];
}

function firstFrom(keys: readonly { readonly atMs: number }[], atMs: number): number {
  let low = 0;
  let high = keys.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((keys[middle]?.atMs ?? Infinity) < atMs) low = middle + 1;
    else high = middle;
  }
  return low;
}
