import fc from 'fast-check';
import { expect, test } from 'vitest';
import { evenly } from '#shared/testing/cases.ts';
import { gripOf, isSideways, placeOf, valueAt } from './useDrag.ts';

const way = { fromPx: 100, lengthPx: 200, min: 500, max: 2_500 };
const px = evenly(-500, 2_000);
const position = fc.integer({ min: way.min, max: way.max });

test.each([
  [100, 500],
  [300, 2_500],
  [200, 1_500],
  [200.05, 1_501],
  [20, 500],
  [900, 2_500],
])('at %d px: %d', (atPx, value) => {
  expect(valueAt(way, atPx)).toBe(value);
});

test('further right is never less, and always within the limits', () => {
  fc.assert(
    fc.property(px, px, (one, other) => {
      const [left, right] = [Math.min(one, other), Math.max(one, other)].map((atPx) => valueAt(way, atPx));
      expect(left).toBeLessThanOrEqual(right ?? NaN);
      expect(left).toBeGreaterThanOrEqual(way.min);
      expect(right).toBeLessThanOrEqual(way.max);
    }),
  );
});

test('a thumb that is taken stays where it is until the pointer moves', () => {
  fc.assert(
    fc.property(position, evenly(-9, 9), (value, besidePx) => {
      const atPx = placeOf(way, value) + besidePx;
      const held = gripOf(way, value, { atPx, reachPx: 9.001, isFinger: true });
      expect(held).not.toBeNull();
      expect(valueAt(way, atPx - (held ?? NaN))).toBe(value);
    }),
  );
});

test('beside the thumb a mouse calls it under itself, a finger never takes it', () => {
  fc.assert(
    fc.property(position, px, (value, atPx) => {
      fc.pre(Math.abs(atPx - placeOf(way, value)) > 22);
      expect(gripOf(way, value, { atPx, reachPx: 22, isFinger: true })).toBeNull();
      expect(gripOf(way, value, { atPx, reachPx: 22, isFinger: false })).toBe(0);
    }),
  );
});

test('a way of one place has its thumb there', () => {
  expect(placeOf({ ...way, max: way.min }, way.min)).toBe(way.fromPx);
});

test.each([
  ['a tremble', 5, 0, false],
  ['to the right', 10, 2, true],
  ['to the left', -10, 2, true],
  ['up, and a little aside', 8, -15, false],
  ['down', 0, 40, false],
])('%s', (_, x, y, drags) => {
  expect(isSideways({ x: 50, y: 50 }, { x: 50 + x, y: 50 + y })).toBe(drags);
});
