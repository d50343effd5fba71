import { expect, test } from 'vitest';
import { paintNeedles, type NeedlesAt } from './Dial.tsx';
import { recordingPen } from './penUnderTest.ts';

/** A unit of a face is a pixel of it. */
const DIAMETER = 48;
const NONE = { target: null, needle: null, preview: null };

function drawn(...dials: readonly NeedlesAt[]) {
  const { pen, strokes } = recordingPen({ width: 200, height: 100 });
  paintNeedles(pen.ctx, pen.look, DIAMETER, dials);
  return strokes.map(({ kind, colour, points }) => ({
    ...{ kind, colour },
    points: points.map(([x, y]) => [Math.round(x), Math.round(y)]),
  }));
}

test('of a servo of unknown position nothing is drawn', () => {
  expect(drawn({ spot: { x: 24, y: 24 }, needles: NONE })).toEqual([]);
});

test('a needle points from the hub to where it is turned', () => {
  const pointing = (needle: number) => drawn({ spot: { x: 50, y: 50 }, needles: { ...NONE, needle } })[0];
  const tip = (needle: number) => pointing(needle)?.points.slice(1, 3);
  expect(pointing(0)).toMatchObject({ kind: 'fill', colour: 'estimated' });
  expect(tip(0)).toEqual([
    [49, 36],
    [51, 36],
  ]);
  expect(tip(90)).toEqual([
    [64, 49],
    [64, 51],
  ]);
  expect(tip(-90)).toEqual([
    [36, 51],
    [36, 49],
  ]);
});

test('dozens of dials are drawn in as many strokes as one', () => {
  const dial = (x: number): NeedlesAt => ({
    spot: { x, y: 24 },
    needles: { target: 30, needle: 10, preview: -20 },
  });
  const one = drawn(dial(24));
  const two = drawn(dial(24), dial(124));
  expect(two.map(({ kind, colour }) => [kind, colour])).toEqual([
    ['fill', 'commanded'],
    ['fill', 'panel'],
    ['fill', 'estimated'],
    ['stroke', 'ink'],
  ]);
  expect(two.map(({ points }) => points)).toEqual(
    one.map(({ points }) => [...points, ...points.map(([x = 0, y]) => [x + 100, y])]),
  );
});
