import { expect, test } from 'vitest';
import { stepOf } from './NumberField.tsx';

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
