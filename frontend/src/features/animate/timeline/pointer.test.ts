import { expect, test } from 'vitest';
import { edgeStep } from './pointer.ts';

test('tracks rest below what is on them, and scroll the faster the farther it is past their ends', () => {
  expect([0, 400, 800].map((x) => edgeStep(x, 800))).toEqual([0, 0, 0]);
  expect(edgeStep(-6, 800)).toBe(-3);
  expect(edgeStep(806, 800)).toBe(3);
  expect(edgeStep(2000, 800)).toBe(24);
  expect(edgeStep(-2000, 800)).toBe(-24);
});
