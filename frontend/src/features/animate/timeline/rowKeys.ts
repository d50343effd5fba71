// The keys of a row in the order of time, and those within a stretch of it. Pure; knows no screen.

import type { Key } from '#shared/group/tracks.ts';
import type { GroupTimes } from '#shared/group/groupTimes.ts';
import type { Row } from './rows.ts';

const NONE: readonly Key[] = [];

/** The very same list as long as it says the same. In rows of several servos one for each frame that has a key of any. */
export function keysInRow(row: Row, times: GroupTimes): readonly Key[] {
  const [only] = row.servos;
  if (row.kind === 'servo') return times.tracks.get(only ?? -1)?.keys ?? NONE;
  return summaryKeys(row, times);
}

/** By the ends of the frames, which are the very same as long as no key came, went or moved in time. */
const summaries = new WeakMap<GroupTimes['ends'], WeakMap<Row['servos'], readonly Key[]>>();

function summaryKeys(row: Row, times: GroupTimes): readonly Key[] {
  const known = summaries.get(times.ends) ?? new WeakMap<Row['servos'], readonly Key[]>();
  summaries.set(times.ends, known);
  const keys = known.get(row.servos) ?? newSummary(row, times);
  known.set(row.servos, keys);
  return keys;
}

function newSummary(row: Row, times: GroupTimes): readonly Key[] {
  const servos = new Set(row.servos);
  let atMs = 0;
  return times.frames.flatMap(({ id: frameId, durationMs, targets, easing }) => {
    atMs += durationMs;
    const isIn = row.kind === 'all' || targets.some(({ servo }) => servos.has(servo));
    return isIn ? [{ frameId, servo: -1, atMs, position: 0, easing }] : [];
  });
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
