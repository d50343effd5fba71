import fc from 'fast-check';
import { expect, test } from 'vitest';
import { valueAt } from './sliderValue.ts';

const lane = { fromPx: 100, lengthPx: 200, min: 500, max: 2_500 };

test.each([
  [100, 500],
  [300, 2_500],
  [200, 1_500],
  [200.05, 1_501],
  [20, 500],
  [900, 2_500],
])('at %d px: %d', (atPx, value) => {
  expect(valueAt({ ...lane, atPx })).toBe(value);
});

test('further right is never less, and always within the limits', () => {
  const px = fc.double({ min: -500, max: 2_000, noNaN: true });
  fc.assert(
    fc.property(px, px, (one, other) => {
      const [left, right] = [Math.min(one, other), Math.max(one, other)].map((atPx) =>
        valueAt({ ...lane, atPx }),
      );
      expect(left).toBeLessThanOrEqual(right ?? NaN);
      expect(left).toBeGreaterThanOrEqual(lane.min);
      expect(right).toBeLessThanOrEqual(lane.max);
    }),
  );
});
