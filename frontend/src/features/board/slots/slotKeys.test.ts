import { expect, test } from 'vitest';
import { slotAfterKey } from './SlotBoard.tsx';

const GRID = { min: 0, max: 229, columns: 16 };

test('arrows go through the grid and stay in it', () => {
  expect(slotAfterKey('ArrowRight', 15, GRID)).toBe(16);
  expect(slotAfterKey('ArrowDown', 15, GRID)).toBe(31);
  expect(slotAfterKey('ArrowUp', 15, GRID)).toBe(15);
  expect(slotAfterKey('ArrowLeft', 0, GRID)).toBe(0);
  expect(slotAfterKey('ArrowDown', 220, GRID)).toBe(220);
  expect(slotAfterKey('Home', 77, GRID)).toBe(0);
  expect(slotAfterKey('End', 77, GRID)).toBe(229);
  expect(slotAfterKey('Enter', 77, GRID)).toBeNull();
});
