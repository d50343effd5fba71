// The rows of the timeline: one for all, one for each limb, one for each servo, in the robot's order. Knows no screen.

import type { Robot, RobotServo } from '#shared/profile/robot.ts';
import { limbsOf } from '../../picture/pose.ts';
import type { ServoView } from '../../servoView.ts';
import { ALL_ROW, type LargeRow } from './timeline.ts';
import type { Key } from '#shared/group/tracks.ts';
import type { GroupTimes } from '#shared/group/groupTimes.ts';
import { positionRange, type Family, type Range } from '#shared/codec/families.ts';

export interface Row {
  readonly id: string;
  readonly kind: 'all' | 'limb' | 'servo';
  /** The servos whose keys are in it. */
  readonly servos: readonly number[];
  /** As the robot calls it; empty where it has no name. */
  readonly name: string;
  /** Null in rows of several, and for servos that the robot does not have. */
  readonly servo: RobotServo | null;
}

export const servoRowId = (servo: number): string => `servo ${servo}`;

let latest: { readonly of: readonly unknown[]; readonly rows: readonly Row[] } | null = null;

/** The very same list as before as long as it is of the same. */
export function rowsNow(
  robot: Robot,
  keyed: readonly number[],
  view: Pick<ServoView, 'hidden' | 'folded'>,
): readonly Row[] {
  const of = [robot, keyed, view.hidden, view.folded];
  if (latest === null || !of.every((part, index) => part === latest?.of[index]))
    latest = { of, rows: rowsOf(robot, keyed, view) };
  return latest.rows;
}

/** The first one is that of all servos. `keyed`: servos that have keys, those the robot does not have too. */
function rowsOf(
  { servos }: Robot,
  keyed: readonly number[],
  { hidden, folded }: Pick<ServoView, 'hidden' | 'folded'>,
): readonly Row[] {
  const shown = servos.filter(({ servo }) => !hidden.includes(servo));
  const limbs = limbsOf(shown);
  const own = limbs.flatMap(({ group, servos: members }) => {
    const rows = members.map(servoRow);
    if (limbs.length === 1) return rows;
    return [limbRow(group, members), ...(folded.includes(group) ? [] : rows)];
  });
  const known = new Set([...hidden, ...servos.map(({ servo }) => servo)]);
  const strange = keyed.filter((number) => !known.has(number));
  const all = [...shown.map(({ servo }) => servo), ...strange];
  return [
    { id: ALL_ROW, kind: 'all', servos: all, name: '', servo: null },
    ...own,
    ...strange.map((number): Row => ({
      ...{ id: servoRowId(number), kind: 'servo', servos: [number] },
      ...{ name: '', servo: null },
    })),
  ];
}

function servoRow(servo: RobotServo): Row {
  return { id: servoRowId(servo.servo), kind: 'servo', servos: [servo.servo], name: servo.name, servo };
}

function limbRow(group: string, members: readonly RobotServo[]): Row {
  return {
    ...{ id: `limb ${group}`, kind: 'limb', name: group, servo: null },
    servos: members.map(({ servo }) => servo),
  };
}

export interface RowHeights {
  readonly summary: number;
  readonly servo: number;
  readonly large: LargeRow | null;
  readonly largePx: number;
  /** What the heights of servos' rows stand for; of those that are left out, all that the servo may do. */
  readonly ranges: ReadonlyMap<number, Range>;
}

export interface PlacedRow {
  readonly row: Row;
  readonly top: number;
  readonly height: number;
  /** What its height stands for; null: all that its servo may do. */
  readonly range: Range | null;
  /** Open as a graph. */
  readonly isLarge: boolean;
}

/** One below the other from 0 on. */
export function placedRows(rows: readonly Row[], heights: RowHeights): readonly PlacedRow[] {
  let top = 0;
  return rows.map((row) => {
    const large = row.kind === 'servo' && row.servos[0] === heights.large?.servo ? heights.large : null;
    const usual = row.kind === 'servo' ? heights.servo : heights.summary;
    const height = large === null ? usual : heights.largePx;
    const range = large ?? (row.kind === 'servo' ? (heights.ranges.get(row.servos[0] ?? -1) ?? null) : null);
    const placed = { row, top, height, range, isLarge: large !== null };
    top += height;
    return placed;
  });
}

export const heightOf = (rows: readonly PlacedRow[]): number =>
  (rows.at(-1)?.top ?? 0) + (rows.at(-1)?.height ?? 0);

/** Those of which anything is seen. */
export function seenRows(rows: readonly PlacedRow[], fromPx: number, heightPx: number): readonly PlacedRow[] {
  return rows.filter(({ top, height }) => top + height > fromPx && top < fromPx + heightPx);
}

/** How far the rows are scrolled then: no farther than it takes to see all of that one. */
export function scrolledTo(
  { top, height }: Pick<PlacedRow, 'top' | 'height'>,
  scrollTop: number,
  heightPx: number,
): number {
  return Math.min(top, Math.max(scrollTop, top + height - heightPx));
}

// How large the parts of the timeline are: fine for a mouse, large enough for a finger. What is fixed on top is the ruler, the
// heads of the frames and the row of all servos; the other rows scroll below.

export interface Sizes extends RowHeights {
  readonly ruler: number;
  readonly heads: number;
  /** How far beside a thing it is still hit. */
  readonly reach: number;
}

const FINE = { ruler: 22, heads: 22, summary: 26, servo: 28, reach: 8 };
const COARSE = { ruler: 44, heads: 44, summary: 44, servo: 44, reach: 22 };
const TALL_PX = 104;
/** All of it in sight, but no lower than a curve can be read in. */
const [LEAST_LARGE_PX, LARGE_PX] = [120, 220];

export interface Heights {
  readonly isTall: boolean;
  readonly large: LargeRow | null;
  /** Of the tracks; 0 before they are drawn. */
  readonly heightPx?: number;
  readonly ranges?: ReadonlyMap<number, Range>;
}

const NO_RANGES: ReadonlyMap<number, Range> = new Map();

export function sizesOf(isCoarse: boolean, heights: Heights): Sizes {
  const { isTall, large, heightPx = 0, ranges = NO_RANGES } = heights;
  const sizes = isCoarse ? COARSE : FINE;
  const seenPx = heightPx === 0 ? LARGE_PX : heightPx - sizes.ruler - sizes.heads - sizes.summary;
  const largePx = Math.max(LEAST_LARGE_PX, Math.min(LARGE_PX, seenPx));
  return { ...sizes, large, largePx, ranges, ...(isTall && { servo: TALL_PX }) };
}

export const topOfAll = ({ ruler, heads }: Sizes): number => ruler + heads;
export const topOfRows = (sizes: Sizes): number => topOfAll(sizes) + sizes.summary;

// The keys of a row in the order of time, and those within a stretch of it. Pure; knows no screen.

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

const INSET_PX = 7;

/** What the row's height stands for. */
function rangeOfRow({ servo, servos }: Row, family: Family): Range {
  return servo ?? positionRange(family, servos[0] ?? 0);
}

/** What is beyond the row's range stands at its edge. */
export function keyY(
  { row, top, height, range }: Omit<PlacedRow, 'isLarge'>,
  position: number,
  family: Family,
): number {
  if (row.kind !== 'servo') return top + height / 2;
  const { min, max } = range ?? rangeOfRow(row, family);
  const share = Math.min(1, Math.max(0, (position - min) / (max - min)));
  return top + INSET_PX + (1 - share) * (height - 2 * INSET_PX);
}

/** Above and below the row too. */
export function positionAtY({ row, top, height, range }: PlacedRow, y: number, family: Family): number {
  const { min, max } = range ?? rangeOfRow(row, family);
  return max - ((y - top - INSET_PX) / (height - 2 * INSET_PX)) * (max - min);
}

export interface Spot {
  readonly x: number;
  readonly y: number;
}
