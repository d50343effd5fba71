import { expect, test } from 'vitest';
import { choiceFor, type Choice } from './slots.ts';

const NONE: Choice = { selection: '', name: '' };

test('the first group that all have is offered, and is kept while they are selected', () => {
  const choice = choiceFor(NONE, 'arm-1 arm-2', ['Bow', 'Wave']);
  expect(choice).toEqual({ selection: 'arm-1 arm-2', name: 'Bow' });
  // One more of them is ready and has another group in common.
  expect(choiceFor(choice, 'arm-1 arm-2', ['Wave'])).toBe(choice);
  expect(choiceFor(choice, 'arm-1 arm-2', [])).toBe(choice);
});

test('another selection keeps the group if all of it have it, and gets another one otherwise', () => {
  const choice: Choice = { selection: 'arm-1', name: 'Wave' };
  expect(choiceFor(choice, 'arm-1 arm-2', ['Bow', 'Wave']).name).toBe('Wave');
  expect(choiceFor(choice, 'arm-2', ['Bow']).name).toBe('Bow');
});

test('of robots that had none in common, the first that comes is offered', () => {
  expect(choiceFor(choiceFor(NONE, 'arm-1', []), 'arm-1', ['Bow']).name).toBe('Bow');
});
