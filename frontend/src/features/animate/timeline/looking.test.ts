import { describe, expect, test } from 'vitest';
import { beside, walked, type Cell, type Grid } from './looking.ts';

const CELLS: Readonly<Record<string, readonly Cell[]>> = {
  all: [
    { frameId: 7, atMs: 100 },
    { frameId: 3, atMs: 500 },
    { frameId: 5, atMs: 900 },
  ],
  elbow: [
    { frameId: 7, atMs: 100 },
    { frameId: 5, atMs: 900 },
  ],
  base: [],
  gripper: [{ frameId: 3, atMs: 500 }],
};
const grid: Grid = { rows: Object.keys(CELLS), cellsOf: (row) => CELLS[row] ?? [] };

describe('the arrow keys', () => {
  test('lead along a row from key to key and stop at its ends', () => {
    expect(walked(grid, { row: 'elbow', frameId: 7 }, 'right', 0)).toEqual({ row: 'elbow', frameId: 5 });
    expect(walked(grid, { row: 'elbow', frameId: 5 }, 'right', 0)).toEqual({ row: 'elbow', frameId: 5 });
    expect(walked(grid, { row: 'all', frameId: 3 }, 'left', 0)).toEqual({ row: 'all', frameId: 7 });
  });

  test('begin at the key nearest to the playhead', () => {
    expect(walked(grid, { row: 'elbow', frameId: null }, 'left', 800)).toEqual({ row: 'elbow', frameId: 5 });
  });

  test('lead across the rows to the nearest key, through rows without one', () => {
    expect(walked(grid, { row: 'all', frameId: 3 }, 'down', 0)).toEqual({ row: 'elbow', frameId: 7 });
    const empty = walked(grid, { row: 'elbow', frameId: 5 }, 'down', 0);
    expect(empty).toEqual({ row: 'base', frameId: null });
    expect(walked(grid, empty, 'down', 0)).toEqual({ row: 'gripper', frameId: 3 });
    expect(walked(grid, { row: 'gripper', frameId: 3 }, 'down', 0)).toEqual({ row: 'gripper', frameId: 3 });
    expect(walked(grid, { row: 'all', frameId: 3 }, 'up', 0)).toEqual({ row: 'all', frameId: 3 });
  });

  test('find the grid again from a row that is gone', () => {
    expect(walked(grid, { row: 'hidden', frameId: 3 }, 'down', 0)).toEqual({ row: 'all', frameId: 7 });
  });
});

test('from key to key the next one on either side of an instant is found', () => {
  expect(beside(CELLS.all ?? [], 500, 1)?.atMs).toBe(900);
  expect(beside(CELLS.all ?? [], 500, -1)?.atMs).toBe(100);
  expect(beside(CELLS.all ?? [], 900, 1)).toBeNull();
});
