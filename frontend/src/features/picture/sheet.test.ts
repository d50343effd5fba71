import { beforeEach, describe, expect, test, vi } from 'vitest';
import type { Pen } from './Canvas.tsx';
import { recordingPen } from './penUnderTest.ts';
import { coverOf, createPainting, createSheet, type Placed } from './SharedSheet.tsx';

const LIST = elementAt({ left: 10, top: 100, width: 500, height: 2_000 });

interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

function elementAt(box: Box): Element {
  return { getBoundingClientRect: () => ({ ...box }) } as unknown as Element;
}

function partAt(box: Box, isInSight = true) {
  const sight = { current: isInSight };
  const paint = vi.fn<(pen: Pen) => void>();
  return { place: elementAt(box), box, sight, shown: () => ['value'] as const, paint };
}

const ROW: Box = { left: 30, top: 140, width: 44, height: 20 };

describe('a sheet', () => {
  test('has what is in sight, seen from the corner of its list', () => {
    const sheet = createSheet();
    sheet.add(partAt(ROW));
    sheet.add(partAt({ ...ROW, top: 900 }, false));
    expect(sheet.inSight(LIST)).toMatchObject([
      { left: 20, top: 40, size: { width: 44, height: 20 }, shown: ['value'] },
    ]);
  });

  test('measures when something may stand elsewhere, and keeps a size that is the same', () => {
    const sheet = createSheet();
    const part = partAt({ ...ROW });
    sheet.add(part);
    const [before] = sheet.inSight(LIST);
    part.box.top = 240;
    expect(sheet.inSight(LIST)[0]?.top).toBe(40);
    sheet.measureAnew();
    const [after] = sheet.inSight(LIST);
    expect(after?.top).toBe(140);
    expect(after?.size).toBe(before?.size);
  });

  test('measures what has come into sight', () => {
    const sheet = createSheet();
    const late = partAt({ ...ROW, top: 900 }, false);
    sheet.add(partAt(ROW));
    sheet.add(late);
    sheet.inSight(LIST);
    late.sight.current = true;
    expect(sheet.inSight(LIST).map(({ top }) => top)).toEqual([40, 800]);
  });

  test('forgets what is taken away', () => {
    const sheet = createSheet();
    const takeAway = sheet.add(partAt(ROW));
    takeAway();
    expect(sheet.inSight(LIST)).toEqual([]);
  });
});

const placed = (top: number, height: number, shown: readonly unknown[] = []) => ({
  ...{ part: {}, left: 20.3, top, size: { width: 44, height }, shown },
  paint: vi.fn<(pen: Pen) => void>(),
});

test('the canvas covers all of them, on whole pixels', () => {
  const before = { left: 0, top: 0, width: 300, height: 150 };
  expect(coverOf([placed(40.5, 20), placed(96.5, 30.2)], before)).toEqual({
    ...{ left: 20, top: 40, width: 45, height: 87 },
  });
  expect(coverOf([], before)).toBe(before);
});

describe('what is on the canvas', () => {
  const cover = { left: 10, top: 100, width: 500, height: 300 };

  function canvas() {
    const cleared: (readonly number[])[] = [];
    const moves: (readonly [number, number])[] = [];
    const ctx = {
      clearRect: (...area: number[]) => void cleared.push(area),
      translate: (x: number, y: number) => void moves.push([x, y]),
    };
    const { look, size } = recordingPen(cover).pen;
    const paintOn = createPainting();
    return {
      ...{ cleared, moves },
      paint: (parts: readonly Placed[], { onto = cover, isClean = false } = {}) =>
        paintOn({ look, size, ctx: ctx as unknown as CanvasRenderingContext2D }, parts, onto, isClean),
    };
  }

  beforeEach(() => vi.stubGlobal('devicePixelRatio', 2));

  test('is each where it stands, as large as it is, on a whole pixel of the screen', () => {
    const { moves, paint } = canvas();
    const part = placed(140.1, 20);
    paint([part]);
    expect(moves).toEqual([
      [10.5, 40],
      [-10.5, -40],
    ]);
    expect(part.paint).toHaveBeenCalledWith(expect.objectContaining({ size: part.size }));
  });

  test('is painted again where it shows something else', () => {
    const { cleared, paint } = canvas();
    const [still, moving] = [placed(140, 20), placed(180, 20.2, [1])];
    paint([still, moving]);
    cleared.length = 0;
    paint([still, { ...moving, shown: [2] }]);
    expect(still.paint).toHaveBeenCalledTimes(1);
    expect(moving.paint).toHaveBeenCalledTimes(2);
    expect(cleared).toEqual([[10.5, 80, 44, 20.5]]);
  });

  test('leaves where it was, moved or gone', () => {
    const { cleared, paint } = canvas();
    const [still, moving, gone] = [placed(140, 20), placed(180, 20), placed(220, 20)];
    paint([still, moving, gone]);
    cleared.length = 0;
    paint([still, { ...moving, top: 260 }]);
    expect(cleared).toEqual([
      [10.5, 80, 44, 20],
      [10.5, 120, 44, 20],
    ]);
    expect([still, moving, gone].map((part) => part.paint.mock.calls.length)).toEqual([1, 2, 1]);
  });

  test.each([
    ['the canvas is clean', { isClean: true }],
    ['the canvas is elsewhere', { onto: { ...cover, top: 140 } }],
  ])('is painted again as a whole where %s', (_, how) => {
    const { cleared, paint } = canvas();
    const part = placed(140, 20);
    paint([part]);
    cleared.length = 0;
    paint([part], how);
    expect(cleared).toEqual([[0, 0, 500, 300]]);
    expect(part.paint).toHaveBeenCalledTimes(2);
  });
});
