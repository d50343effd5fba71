// The verbs that change what is looked at: playhead, cursor, zoom, loop range. None of them changes the group.

import type { Key } from '#shared/group/tracks.ts';
import { ALL_ROW, type Cursor, selectedKeys, type SelectMode, type TimeView, withKeys } from './timeline.ts';
import { setChanged } from '../../../state/store.ts';
import { rowOf, select, type TimelineContext } from './context.ts';
import { allKeys, endOfFrame, keysOfFrame, spanOf } from '#shared/group/groupTimes.ts';
import { instantText } from './valueText.ts';
import { fitted, panned, showing, xOf, zoomedAt, type Span } from './timeScale.ts';

// Where the arrow keys lead in the grid: along a row from key to key, across the rows to the key that is nearest in
// time.

export type Direction = 'left' | 'right' | 'up' | 'down';

/** One cell: the frame that a row has a key in. */
export interface Cell {
  readonly frameId: number;
  readonly atMs: number;
}

export interface Grid {
  /** From top to bottom. */
  readonly rows: readonly string[];
  /** In the order of time. */
  cellsOf(row: string): readonly Cell[];
}

/** Stays where it is at the edges. `fromMs` is where the eye is where the row of the cursor has no cell. */
export function walked(grid: Grid, cursor: Cursor, direction: Direction, fromMs: number): Cursor {
  if (direction === 'up' || direction === 'down')
    return across(grid, cursor, direction === 'up' ? -1 : 1, fromMs);
  const cells = grid.cellsOf(cursor.row);
  const index = cells.findIndex(({ frameId }) => frameId === cursor.frameId);
  const next = index === -1 ? nearest(cells, fromMs) : cells[index + (direction === 'left' ? -1 : 1)];
  return next === undefined ? cursor : { ...cursor, frameId: next.frameId };
}

/** At the cell of its row that is nearest to where its own was. */
export function settled(grid: Grid, cursor: Cursor, wasAtMs: number): Cursor {
  return { ...cursor, frameId: nearest(grid.cellsOf(cursor.row), wasAtMs)?.frameId ?? null };
}

/** Jumps in its row to the next cell before or behind an instant; null where there is none. */
export function beside(cells: readonly Cell[], atMs: number, side: -1 | 1): Cell | null {
  const found =
    side === 1 ? cells.find((cell) => cell.atMs > atMs) : cells.findLast((cell) => cell.atMs < atMs);
  return found ?? null;
}

function across({ rows, cellsOf }: Grid, cursor: Cursor, step: -1 | 1, fromMs: number): Cursor {
  const row = rows[Math.max(0, rows.indexOf(cursor.row) + step)];
  if (row === undefined) return cursor;
  const here = cellsOf(cursor.row).find(({ frameId }) => frameId === cursor.frameId);
  return { row, frameId: nearest(cellsOf(row), here?.atMs ?? fromMs)?.frameId ?? null };
}

function nearest(cells: readonly Cell[], atMs: number): Cell | undefined {
  return cells.reduce<Cell | undefined>(
    (best, cell) =>
      best !== undefined && Math.abs(best.atMs - atMs) <= Math.abs(cell.atMs - atMs) ? best : cell,
    undefined,
  );
}

const ZOOM = 1.5;
/** An empty group is seen as a short one. */
const EMPTY_MS = 5000;

/** Brings the instant into sight. */
export function lookAt({ stores }: TimelineContext, atMs: number): void {
  const playheadMs = Math.max(0, Math.round(atMs));
  stores.timeline.setState(({ time, widthPx }) => ({ playheadMs, time: showing(time, playheadMs, widthPx) }));
}

/** The same by keys, for ears too. */
export function stepTo(context: TimelineContext, atMs: number): void {
  lookAt(context, atMs);
  context.stores.notices.say(instantText(context.stores.timeline.getState().playheadMs));
}

/** By so many of the board's ticks, the first one from where it is. */
export function stepTicks(context: TimelineContext, count: number): void {
  const { tickMs } = context.family.motion;
  const ticks = context.state.playheadMs / tickMs;
  stepTo(context, ((count > 0 ? Math.floor(ticks) : Math.ceil(ticks)) + count) * tickMs);
}

/** Most of what is in sight, so that the eye finds where it was. */
const PAGE = 0.8;

export function page(context: TimelineContext, side: -1 | 1): void {
  setTime(context, (time) => panned(time, side * PAGE * context.state.widthPx));
}

/** The cursor, or where its key is gone the nearest one of its row. */
export function cursorLeft(context: TimelineContext, wasAtMs: number): Cursor {
  const { cursor } = context.state;
  const isThere =
    cursor.row === ALL_ROW
      ? endOfFrame(context.times, cursor.frameId) !== null
      : keysAtCursor(context, cursor).length > 0;
  return isThere ? cursor : settled(gridOf(context), cursor, wasAtMs);
}

function gridOf({ rows, times }: TimelineContext): Grid {
  return {
    rows: rows.map(({ id }) => id),
    cellsOf: (id) => cellsOf(rows.find((row) => row.id === id)?.servos ?? [], times, id === ALL_ROW),
  };
}

function cellsOf(
  servos: readonly number[],
  times: TimelineContext['times'],
  isAll: boolean,
): readonly Cell[] {
  const frames = new Set(allKeys(times, servos).map(({ frameId }) => frameId));
  return times.frames.flatMap(({ id: frameId }, index) =>
    isAll || frames.has(frameId) ? [{ frameId, atMs: times.ends[index] ?? 0 }] : [],
  );
}

function keysAtCursor(
  { rows, times }: Pick<TimelineContext, 'rows' | 'times'>,
  { row, frameId }: Cursor,
): readonly Key[] {
  return frameId === null ? [] : keysOfFrame(times, rowOf({ rows }, row)?.servos ?? [], frameId);
}

/** Null: the cursor goes alone, the selection stays. */
export function walk(context: TimelineContext, direction: Direction, mode: SelectMode | null): void {
  goTo(context, walked(gridOf(context), context.state.cursor, direction, context.state.playheadMs), mode);
}

function goTo(context: TimelineContext, cursor: Cursor, mode: SelectMode | null): void {
  const keys = keysAtCursor(context, cursor);
  const selected = mode === null ? null : withKeys(context.state.selected, keys, mode);
  select(context.stores, selected, cursor);
  const endMs = endOfFrame(context.times, cursor.frameId);
  if (endMs !== null)
    context.stores.timeline.setState(({ time, widthPx }) => ({ time: showing(time, endMs, widthPx) }));
}

export function toggleAtCursor(context: TimelineContext): void {
  goTo(context, context.state.cursor, 'toggles');
}

/** From the playhead to the next key of the cursor's row, which is selected then. */
export function goToKey(context: TimelineContext, side: -1 | 1): void {
  const { row } = context.state.cursor;
  const cell = beside(gridOf(context).cellsOf(row), context.state.playheadMs, side);
  if (cell === null) return;
  goTo(context, { row, frameId: cell.frameId }, 'replaces');
  lookAt(context, cell.atMs);
}

export function selectRow(context: TimelineContext, id: string, mode: SelectMode): void {
  const keys = allKeys(context.times, rowOf(context, id)?.servos ?? []);
  select(context.stores, withKeys(context.state.selected, keys, mode), {
    row: id,
    frameId: keys[0]?.frameId ?? null,
  });
}

/** Of all rows that are shown. */
export const shownKeys = (context: TimelineContext, frameId: number): readonly Key[] =>
  keysOfFrame(context.times, rowOf(context, ALL_ROW)?.servos ?? [], frameId);

export function selectFrame(context: TimelineContext, frameId: number, mode: SelectMode): void {
  const keys = shownKeys(context, frameId);
  select(context.stores, withKeys(context.state.selected, keys, mode), { row: ALL_ROW, frameId });
  // A frame without keys is selected too, though nothing of it is.
  if (mode === 'replaces') context.stores.view.setState({ selectedFrame: frameId });
}

export function setTime(
  { stores }: Pick<TimelineContext, 'stores'>,
  change: (time: TimeView) => TimeView,
): void {
  stores.timeline.setState(({ time }) => ({ time: change(time), followsGroup: false }));
}

/** Where the eye is: at the cursor's key, else at the playhead; where neither is in sight, in the middle. */
export function zoom(context: TimelineContext, step: 1 | -1): void {
  const { widthPx, playheadMs, cursor, time } = context.state;
  const seen = [endOfFrame(context.times, cursor.frameId), playheadMs]
    .map((atMs) => (atMs === null ? NaN : xOf(time, atMs)))
    .find((x) => x >= 0 && x <= widthPx);
  setTime(context, (before) => zoomedAt(before, seen ?? widthPx / 2, ZOOM ** -step));
}

export function fitAll({ stores, times }: Pick<TimelineContext, 'stores' | 'times'>): void {
  const { time, widthPx } = stores.timeline.getState();
  const whole = fitted({ fromMs: 0, toMs: times.lengthMs || EMPTY_MS }, widthPx);
  setChanged(stores.timeline, { time: sameOr(time, whole), followsGroup: true });
}

/** The same object where it shows the same: views of it need no update. */
const sameOr = (before: TimeView, after: TimeView): TimeView =>
  before.fromMs === after.fromMs && before.msPerPx === after.msPerPx ? before : after;

const selectedSpan = ({ times, state }: TimelineContext): Span | null =>
  spanOf(selectedKeys(times, state.selected));

export function fitSelection(context: TimelineContext): void {
  const span = selectedSpan(context);
  if (span !== null) setTime(context, () => fitted(span, context.state.widthPx));
}

/** The selected stretch, or none any more. */
export function toggleRange(context: TimelineContext): void {
  const span = selectedSpan(context);
  const isNew = span !== null && span.toMs > span.fromMs && context.state.range === null;
  context.stores.timeline.setState({ range: isNew ? span : null });
}
