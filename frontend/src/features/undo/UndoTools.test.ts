import { expect, test } from 'vitest';
import { actionOf } from '../../ui/action.ts';
import { createUndoable } from '../../state/store.ts';
import { words } from '../../i18n/words.ts';
import { REDO, UNDO } from './UndoTools.tsx';

test('undo and redo answer to the keys of every system', () => {
  const action = (key: string, more = {}) =>
    actionOf([UNDO, REDO], {
      ...{ key, ctrlKey: true, metaKey: false, shiftKey: false, altKey: false, ...more },
    })?.id;
  expect(action('z')).toBe('undo');
  expect(action('Z', { shiftKey: true })).toBe('redo');
  expect(action('y')).toBe('redo');
  expect(action('z', { ctrlKey: false, metaKey: true })).toBe('undo');
  expect(action('z', { ctrlKey: false })).toBeUndefined();
});

test('each says what it takes back, or that there is nothing', () => {
  const written = createUndoable(1, () => undefined);
  const said = () => [UNDO, REDO].map((action) => [action.label(written), action.enabled(written)]);
  const { undo, redo, nothingToUndo, nothingToRedo } = words.actions;
  expect(said()).toEqual([
    [undo, nothingToUndo],
    [redo, nothingToRedo],
  ]);
  written.edit(
    () => 'add',
    (before) => before + 1,
  );
  expect(said()).toEqual([
    ['Undo: add', true],
    [redo, nothingToRedo],
  ]);
  UNDO.run(written);
  expect(said()).toEqual([
    [undo, nothingToUndo],
    ['Redo: add', true],
  ]);
});
