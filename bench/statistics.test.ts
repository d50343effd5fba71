import { expect, test } from 'vitest';
import { median, percentile } from './statistics.ts';

const hundred = Array.from({ length: 100 }, (_, index) => 100 - index);

test('a percentile is the smallest sample that covers that share of all', () => {
  expect(percentile(hundred, 99)).toBe(99);
  expect(percentile(hundred, 100)).toBe(100);
  expect(percentile([3, 1, 2], 99)).toBe(3);
  expect(percentile([7], 1)).toBe(7);
});

test('the median is a sample, whatever their number and order', () => {
  expect(median([9, 1, 5])).toBe(5);
  expect(median([4, 1, 3, 2])).toBe(2);
});

test('nothing can be said of no samples', () => {
  expect(() => median([])).toThrow('no samples');
});
