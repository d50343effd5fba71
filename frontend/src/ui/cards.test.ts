import { expect, test } from 'vitest';
import { neighbour } from './cards.ts';

test('arrows lead to the neighbour and stop at the ends', () => {
  expect(neighbour('ArrowRight', 1, 3)).toBe(2);
  expect(neighbour('ArrowRight', 2, 3)).toBe(2);
  expect(neighbour('ArrowLeft', 0, 3)).toBe(0);
  expect(neighbour('Home', 2, 3)).toBe(0);
  expect(neighbour('End', 0, 3)).toBe(2);
  expect(neighbour('Enter', 0, 3)).toBeNull();
});
