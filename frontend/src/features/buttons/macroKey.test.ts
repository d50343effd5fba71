import { expect, test } from 'vitest';
import { macroKey } from './MacroGrid.tsx';

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
