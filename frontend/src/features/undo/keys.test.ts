import { describe, expect, test } from 'vitest';
import { neighbour } from '../../ui/cards.ts';
import { undoActionOf } from './useUndoKeys.ts';

describe('keys of the action group', () => {
  test('arrows lead to the neighbour and stop at the ends', () => {
    expect(neighbour('ArrowRight', 1, 3)).toBe(2);
    expect(neighbour('ArrowRight', 2, 3)).toBe(2);
    expect(neighbour('ArrowLeft', 0, 3)).toBe(0);
    expect(neighbour('Home', 2, 3)).toBe(0);
    expect(neighbour('End', 0, 3)).toBe(2);
    expect(neighbour('Enter', 0, 3)).toBeNull();
  });

  const keys = (key: string, more = {}) => ({ key, ctrlKey: true, metaKey: false, shiftKey: false, ...more });

  test('undo and redo answer to the keys of every system', () => {
    expect(undoActionOf(keys('z'))).toBe('undo');
    expect(undoActionOf(keys('Z', { shiftKey: true }))).toBe('redo');
    expect(undoActionOf(keys('y'))).toBe('redo');
    expect(undoActionOf(keys('z', { ctrlKey: false, metaKey: true }))).toBe('undo');
    expect(undoActionOf(keys('z', { ctrlKey: false }))).toBeNull();
  });
});
