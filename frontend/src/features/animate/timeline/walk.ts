// Where the arrow keys lead in the grid: along a row from key to key, across the rows to the key that is nearest in time. Pure.

import type { Cursor } from './timeline.ts';

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
