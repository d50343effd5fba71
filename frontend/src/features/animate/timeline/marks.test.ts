import fc from 'fast-check';
import { expect, test } from 'vitest';
import { marksWithin, markStep } from './paintHeads.ts';

test('labels never touch and are never far apart, however far one zooms', () => {
  fc.assert(
    fc.property(fc.double({ min: 0.1, max: 4000, noNaN: true }), (msPerPx) => {
      const [stepMs] = markStep(msPerPx);
      expect(stepMs / msPerPx).toBeGreaterThanOrEqual(72);
      expect(stepMs / msPerPx).toBeLessThan(Math.max(72 * 4, 1.01 / msPerPx));
    }),
  );
});

test('marks stand at round times within what is seen, every fifth one labelled', () => {
  const marks = marksWithin({ fromMs: 900, toMs: 2300 }, 10);
  expect(marks.map(({ atMs }) => atMs)).toEqual([1000, 1200, 1400, 1600, 1800, 2000, 2200]);
  expect(marks.filter(({ isMain }) => isMain).map(({ atMs }) => atMs)).toEqual([1000, 2000]);
});

test('nothing is marked before the beginning', () => {
  expect(marksWithin({ fromMs: -500, toMs: 0 }, 10)).toEqual([{ atMs: 0, isMain: true }]);
});
