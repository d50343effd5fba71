import { expect, test } from 'vitest';
import { hoverAt } from './trackCanvas.ts';
import { createTestTimeline } from './timelineUnderTest.ts';
import { sizesOf } from './sizes.ts';

test('what a press would do is said of each place before it is pressed', async () => {
  const { stores, spotOf, select } = await createTestTimeline();
  const statusAt = (spot: { x: number; y: number }) => hoverAt(stores, sizesOf(false, false), spot).status;
  expect(statusAt({ x: 30, y: 5 })).toBe('scrub');
  expect(statusAt({ x: 100, y: 33 })).toBe('duration');
  expect(statusAt({ x: 75, y: 33 })).toBe('box');
  expect(statusAt(spotOf(1, 2))).toBe('move');
  select([2, 1], [3, 1]);
  expect(statusAt(spotOf(1, 2))).toBe('selected');
  expect(statusAt({ x: 88, y: 57 })).toBe('stretchBack');
  expect(statusAt({ x: 162, y: 57 })).toBe('stretch');
  expect(statusAt({ x: 700, y: 90 })).toBe('nothing');
});
