import { describe, expect, test } from 'vitest';
import type { Reading } from '#shared/files/reading.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { emptyGroup } from '#shared/group/group.ts';
import { filesText } from './fileText.ts';
import { countsOf, firstAnswers, readyGroups, takenAs, type Answer } from './answers.ts';

const group = (name: string, ...positions: readonly number[]) =>
  insertFrame(emptyGroup(name, 'us'), 0, {
    durationMs: 100,
    targets: positions.map((position, index) => ({ servo: index + 1, position })),
  });

const read = (isUnitMissing: boolean, ...groups: readonly ReturnType<typeof group>[]): Reading => ({
  ...{ groups, isUnitMissing, remarks: [] },
});
const opened = (id: number, reading: Reading) => ({ id, reading, answers: firstAnswers(reading) });
const STEPS: Answer = { unit: 'steps', converts: false };

describe('the first answer', () => {
  test('is what the file says, or what its numbers leave as the only choice', () => {
    expect(firstAnswers(read(false, group('Nod', 700)))).toEqual([{ unit: 'us', converts: false }]);
    expect(firstAnswers(read(true, group('Nod', 1500)))).toEqual([{ unit: 'us', converts: false }]);
    expect(firstAnswers(read(true, group('Nod', 100)))).toEqual([STEPS]);
    expect(firstAnswers(read(true, group('Nod', 700)))).toEqual([{ unit: null, converts: false }]);
  });
});

describe('a group is taken', () => {
  test('as it is, in the unit that was said', () => {
    expect(takenAs(group('Nod', 700), STEPS, 'us')).toEqual({ ...group('Nod', 700), unit: 'steps' });
  });

  test('with its pulse widths as steps where a person says so and the board counts in them', () => {
    const answer: Answer = { unit: 'us', converts: true };
    const positions = (unit: 'us' | 'steps') =>
      takenAs(group('Nod', 1500, 700), answer, unit).frames[0]?.targets.map(({ position }) => position);
    expect(positions('steps')).toEqual([500, 100]);
    expect(positions('us')).toEqual([1500, 700]);
  });
});

test('what could not be opened is not counted as opened', () => {
  const refused = opened(1, { problem: { code: 'encrypted', place: null, found: '' } });
  const files = [refused, opened(2, read(true, group('Nod', 700)))];
  expect(countsOf(files)).toEqual({ opened: 1, refused: 1 });
  expect(filesText({ opened: 0, refused: 4 })).toBe('Files, 4 not opened');
});

test('all are taken at once but files that ask or are broken', () => {
  const asking = opened(2, read(true, group('Asks', 700), group('Clear', 1500)));
  const files = [
    opened(1, read(false, group('Nod', 700))),
    asking,
    opened(3, { problem: { code: 'encrypted', place: null, found: '' } }),
  ];
  const names = (list: typeof files) => readyGroups(list, 'us').map((one) => [one.file, one.group.name]);
  expect(names(files)).toEqual([[1, 'Nod']]);
  const answered = { ...asking, answers: [STEPS, ...asking.answers.slice(1)] };
  expect(readyGroups([answered], 'us').map(({ group: { name, unit } }) => [name, unit])).toEqual([
    ['Asks', 'steps'],
    ['Clear', 'us'],
  ]);
});
