import { expect, test } from 'vitest';
import type { Listed } from '#shared/files/documentStore.ts';
import { arranged, tagsIn, type Wish } from './DocumentList.tsx';

const document = (name: string, facts: Partial<Listed['facts']> = {}, isRemoved = false): Listed => ({
  ...{ id: name, revision: 1, isRemoved },
  facts: {
    kind: 'group',
    ...{ name, robot: 'Arm', tags: [], updatedAtMs: 0, frames: 1, durationMs: 0, unit: 'us', pose: [] },
    ...facts,
  },
});

const ALL = [
  document('Wave 10', { updatedAtMs: 3, durationMs: 100, tags: ['show'] }),
  document('Wave 9', { updatedAtMs: 1, durationMs: 900, tags: ['hello', 'show'] }),
  document('Bow', { updatedAtMs: 2, durationMs: 500, robot: 'Hexapod' }),
  document('Old', { tags: ['gone'] }, true),
];

const names = (wish: Partial<Wish>): readonly string[] =>
  arranged(ALL, { search: '', sort: 'name', tag: '', isRemoved: false, ...wish }).map(({ id }) => id);

test.each<[Partial<Wish>, string[]]>([
  [{}, ['Bow', 'Wave 9', 'Wave 10']],
  [{ sort: 'updated' }, ['Wave 10', 'Bow', 'Wave 9']],
  [{ sort: 'duration' }, ['Wave 9', 'Bow', 'Wave 10']],
  [{ search: 'wave' }, ['Wave 9', 'Wave 10']],
  [{ search: ' SHOW  9 ' }, ['Wave 9']],
  [{ search: 'hexa' }, ['Bow']],
  [{ search: 'nothing' }, []],
  [{ tag: 'show' }, ['Wave 9', 'Wave 10']],
  [{ isRemoved: true }, ['Old']],
])('%o shows %j', (wish, expected) => {
  expect(names(wish)).toEqual(expected);
});

test('tags come once, from what is not deleted', () => {
  expect(tagsIn(ALL)).toEqual(['hello', 'show']);
});
