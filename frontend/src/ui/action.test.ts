import { expect, test } from 'vitest';
import { chordOf, shortcutsOf } from './action.ts';
import { chordText } from './Hint.tsx';

test('a key is named by what is held with it, Command like Ctrl, and Shift only where it makes no other sign', () => {
  const plain = { ctrlKey: false, metaKey: false, shiftKey: false, altKey: false };
  expect(chordOf({ ...plain, key: 'A', metaKey: true, shiftKey: true })).toBe('Ctrl+Shift+a');
  expect(chordOf({ ...plain, key: '+', shiftKey: true })).toBe('+');
  expect(chordOf({ ...plain, key: 'ArrowLeft', shiftKey: true })).toBe('Shift+ArrowLeft');
});

test('the menu names a key as it is written on it', () => {
  expect(['Ctrl+x', 'r', 'Shift+f', 'Ctrl+Shift+a'].map(chordText)).toEqual([
    'Ctrl+X',
    'R',
    'Shift+F',
    'Ctrl+Shift+A',
  ]);
  expect(['Enter', 'F2', 'Shift+Delete', '+', ','].map(chordText)).toEqual([
    'Enter',
    'F2',
    'Shift+Delete',
    '+',
    ',',
  ]);
});

test('keys are given to the browser in its own words', () => {
  expect(shortcutsOf(['Ctrl+Shift+a', ' ', '+'])).toBe('Control+Shift+a Space +');
});
