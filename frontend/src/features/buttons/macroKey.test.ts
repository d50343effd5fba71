import { expect, test } from 'vitest';
import { columnsFor, macroKey } from './MacroGrid.tsx';

const press = (key: string, more = {}) =>
  macroKey({ key, ctrlKey: false, metaKey: false, altKey: false, repeat: false, ...more });

test.each([
  ['a sign', press('w'), 'w'],
  ['a capital is the same key', press('W'), 'w'],
  ['a digit', press('1'), '1'],
  ['a shortcut', press('z', { ctrlKey: true }), null],
  ['a shortcut of a Mac', press('z', { metaKey: true }), null],
  ['a key held down', press('w', { repeat: true }), null],
  ['STOP', press('Escape'), null],
  ['the space bar, which presses what has the focus', press(' '), null],
])('%s', (_, key, expected) => expect(key).toBe(expected));

test('buttons that fill a screen are in as many columns as make them largest', () => {
  const tablet = { width: 1024, height: 640 };
  expect([1, 2, 3, 4, 6, 9, 12].map((count) => columnsFor(count, tablet))).toEqual([1, 1, 2, 2, 2, 3, 3]);
  expect(columnsFor(5, { width: 390, height: 700 })).toBe(1);
  expect(columnsFor(40, { width: 390, height: 700 })).toBe(2);
});
