import { expect, test } from 'vitest';
import { numberIn, stepOf } from './NumberField.tsx';

const key = (name: string, modifiers: { shiftKey?: boolean; altKey?: boolean } = {}) => ({
  key: name,
  shiftKey: false,
  altKey: false,
  ...modifiers,
});

test('arrows step, Shift steps ten times as far, Alt by one', () => {
  expect(stepOf(key('ArrowUp'), 10)).toBe(10);
  expect(stepOf(key('ArrowDown', { shiftKey: true }), 10)).toBe(-100);
  expect(stepOf(key('ArrowUp', { altKey: true }), 10)).toBe(1);
  expect(stepOf(key('PageDown'), 10)).toBe(-100);
  expect(stepOf(key('a'), 10)).toBe(0);
});

test('a number is read as people write it, with as many decimals as the field has', () => {
  expect(numberIn(' 1500 ', 0)).toBe(1500);
  expect(numberIn('-12,34', 1)).toBe(-12.3);
  expect(numberIn('−4.5', 1)).toBe(-4.5);
  expect(numberIn('12.6', 0)).toBe(13);
  expect(['1,600', '1.600', '1 600', '\u22121,600'].map((text) => numberIn(text, 0))).toEqual([
    1600, 1600, 1600, -1600,
  ]);
  expect(numberIn('1,600', 1)).toBe(1.6);
  for (const text of ['', ' ', '-', '.']) expect(numberIn(text, 0)).toBeNaN();
});
