import { expect, test } from 'vitest';
import { markText, secondsText } from './instants.ts';

test('a key says its time to the hundredth, or to the millisecond where that is needed', () => {
  expect(secondsText(1500)).toBe('1.50');
  expect(secondsText(1502)).toBe('1.502');
});

test('the ruler says no more than its step asks for, and minutes where there are any', () => {
  expect(markText(5000, 5000)).toBe('5');
  expect(markText(1500, 500)).toBe('1.5');
  expect(markText(1502, 2)).toBe('1.502');
  expect(markText(65_000, 1000)).toBe('1:05');
  expect(markText(125_500, 500)).toBe('2:05.5');
});
