import { expect, test } from 'vitest';
import { snapped } from './gesture.ts';

const field = { placesMs: [505, 512, 990], tickMs: 20, reachMs: 15 };

test('the nearest thing within reach wins, then the raster of the board', () => {
  expect(snapped(510, field)).toBe(512);
  expect(snapped(507, field)).toBe(505);
  expect(snapped(751, field)).toBe(760);
});

test('without snapping each millisecond may be meant', () => {
  expect(snapped(507.4, null)).toBe(507);
});
