import { expect, test } from 'vitest';
import { deleteKeys, moveKeys, setKey } from '#shared/group/keyEdits.ts';
import type { ActionGroup } from '#shared/group/group.ts';
import { timesOf } from '#shared/group/groupTimes.ts';
import { keysInRow } from './rows.ts';
import { smallGroup } from './timelineUnderTest.ts';

const row = (kind: 'all' | 'limb' | 'servo', ...servos: number[]) => ({
  ...{ id: `${kind} ${servos.join()}`, kind, servos, name: '', servo: null },
});
const ALL = row('all', 1, 2, 3);
const LIMB = row('limb', 3);
const FIRST = row('servo', 1);

const keysOf = (group: ActionGroup, of: ReturnType<typeof row>) => keysInRow(of, timesOf(group));
const framesOf = (group: ActionGroup, of: ReturnType<typeof row>) =>
  keysOf(group, of).map(({ frameId, atMs }) => [frameId, atMs]);

test('a row of several has a key for each frame that moves one of its servos', () => {
  const group = smallGroup();
  expect(framesOf(group, ALL)).toEqual([
    [1, 500],
    [2, 1000],
    [3, 1500],
  ]);
  expect(framesOf(group, LIMB)).toEqual([
    [1, 500],
    [3, 1500],
  ]);
});

test('views of rows see the very same keys until they are others', () => {
  const group = smallGroup();
  const before = [ALL, LIMB, FIRST].map((one) => keysOf(group, one));
  const nudged = moveKeys(
    group,
    [{ frameId: 2, servo: 2 }],
    { deltaMs: 0, deltaPosition: 9 },
    { ripple: false },
  );
  expect(nudged).not.toBe(group);
  for (const [index, one] of [ALL, LIMB, FIRST].entries()) expect(keysOf(nudged, one)).toBe(before[index]);
  expect(keysOf(nudged, row('servo', 2))).not.toBe(keysOf(group, row('servo', 2)));
  expect(keysOf(nudged, row('servo', 9))).toBe(keysOf(group, row('servo', 9)));
});

test.each([
  ['a key of it came', (group: ActionGroup) => setKey(group, 3, 1000, 1500)],
  [
    'a key of it went',
    (group: ActionGroup) => deleteKeys(group, [{ frameId: 3, servo: 3 }], { ripple: false }),
  ],
  [
    'a key of it moved in time',
    (group: ActionGroup) =>
      moveKeys(group, [{ frameId: 3, servo: 3 }], { deltaMs: 100, deltaPosition: 0 }, { ripple: false }),
  ],
])('a row of several says it where %s', (_, edit) => {
  const group = smallGroup();
  const before = [ALL, LIMB].map((one) => keysOf(group, one));
  const after = edit(group);
  for (const [index, one] of [ALL, LIMB].entries()) expect(keysOf(after, one)).not.toBe(before[index]);
});
