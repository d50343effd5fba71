import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import {
  deleteFrames,
  duplicateFrames,
  insertFrame,
  moveFrames,
  rename,
  setMeta,
  setTargets,
} from './groupEdits.ts';
import { setDuration } from './timeEdits.ts';

const RIPPLE = { ripple: true };
import { changedServos, emptyGroup, poseAt, totalDurationMs, type ActionGroup } from './group.ts';

const ids = (group: ActionGroup) => group.frames.map((frame) => frame.id);

function groupOf(...positions: number[]): ActionGroup {
  return positions.reduce(
    (group, position) =>
      insertFrame(group, group.frames.length, { durationMs: 500, targets: [{ servo: 1, position }] }),
    emptyGroup('Wave', 'us'),
  );
}

describe('edits of an action group', () => {
  test('a new frame goes where it is put and carries its own id', () => {
    const group = insertFrame(groupOf(1000, 2000), 1, { durationMs: 300, targets: [] });
    expect(ids(group)).toEqual([1, 3, 2]);
  });

  test('the first frame of an empty group decides the unit, later ones do not', () => {
    const pose = { durationMs: 100, targets: [{ servo: 1, position: 500 }] };
    const first = insertFrame(emptyGroup('Wave', 'us'), 0, pose, 'steps');
    expect(first.unit).toBe('steps');
    expect(insertFrame(first, 1, pose, 'us').unit).toBe('steps');
  });

  test('targets are kept in servo order, each servo once', () => {
    const targets = [
      { servo: 6, position: 900 },
      { servo: 1, position: 700 },
      { servo: 6, position: 1200 },
    ];
    const group = insertFrame(emptyGroup('Wave', 'us'), 0, { durationMs: 100, targets });
    expect(group.frames[0]!.targets).toEqual([
      { servo: 1, position: 700 },
      { servo: 6, position: 1200 },
    ]);
  });

  test('a duplicate follows its original with a new id, several follow the last of them in their order', () => {
    const group = duplicateFrames(groupOf(1000, 2000), [1]);
    expect(ids(group)).toEqual([1, 3, 2]);
    expect(group.frames[1]!.targets).toEqual(group.frames[0]!.targets);
    const several = duplicateFrames(groupOf(1000, 2000, 1500, 1800), [3, 1]);
    expect(ids(several)).toEqual([1, 2, 3, 5, 6, 4]);
    expect(several.frames.slice(3, 5).map(({ targets }) => targets[0]!.position)).toEqual([1000, 1500]);
  });

  test('several frames go at once', () => {
    expect(ids(deleteFrames(groupOf(1000, 2000, 1500), [3, 1]))).toEqual([2]);
  });

  test('several frames come together around the one that leads', () => {
    const group = groupOf(1000, 2000, 1500, 1800, 1200);
    expect(ids(moveFrames(group, [2, 5], 2, 2))).toEqual([1, 3, 2, 5, 4]);
    expect(ids(moveFrames(group, [2, 5], 5, 2))).toEqual([1, 2, 5, 3, 4]);
    expect(ids(moveFrames(group, [2, 5], 5, 0))).toEqual([2, 5, 1, 3, 4]);
  });

  test('an edit that changes nothing returns the same object', () => {
    const group = groupOf(1000, 2000);
    expect(moveFrames(group, [1, 2], 2, 1)).toBe(group);
    expect(moveFrames(group, [9], 9, 0)).toBe(group);
    expect(moveFrames(group, [1], 2, 1)).toBe(group);
    expect(setDuration(group, 1, 500, RIPPLE)).toBe(group);
    expect(setTargets(group, 1, [{ servo: 1, position: 1000 }])).toBe(group);
    expect(deleteFrames(group, [9])).toBe(group);
    expect(duplicateFrames(group, [9])).toBe(group);
    expect(rename(group, 'Wave')).toBe(group);
  });

  test('a name is no longer than it may be', () => {
    expect(rename(groupOf(1000), 'a'.repeat(70)).name).toBe('a'.repeat(64));
  });

  test('what is said of the whole group is said at once or in part', () => {
    const said = setMeta(groupOf(1000), { name: 'Bow', tags: ['dance'], slot: 3, times: 2, robot: 'Mine' });
    expect(said).toMatchObject({ name: 'Bow', tags: ['dance'], slot: 3, times: 2, robot: 'Mine' });
    expect(setMeta(said, { tags: ['dance'], slot: 3 })).toBe(said);
  });

  test('an edit touches one frame and shares the others', () => {
    const before = groupOf(1000, 2000, 1500);
    const after = setDuration(before, 2, 900, RIPPLE);
    expect(after.frames[1]!.durationMs).toBe(900);
    expect(after.frames[0]).toBe(before.frames[0]);
    expect(after.frames[2]).toBe(before.frames[2]);
    expect(before.frames[1]!.durationMs).toBe(500);
  });

  test('moved frames stand together in their order, the leading one as near to its place as can be, the others as before', () => {
    const some = fc.integer({ min: 1, max: 12 }).chain((count) => {
      const all = Array.from({ length: count }, (_, index) => index + 1);
      const chosen = fc.subarray(all, { minLength: 1 });
      return fc.tuple(fc.constant(all), chosen, fc.nat(11), fc.integer({ min: -3, max: 15 }));
    });
    fc.assert(
      fc.property(some, ([all, chosen, lead, to]) => {
        const group = groupOf(...all.map((id) => 500 + id));
        const id = chosen[lead % chosen.length]!;
        const moved = ids(moveFrames(group, chosen.toReversed(), id, to));
        const first = moved.indexOf(chosen[0]!);
        expect(moved.slice(first, first + chosen.length)).toEqual(chosen);
        expect(moved.filter((one) => !chosen.includes(one))).toEqual(
          all.filter((one) => !chosen.includes(one)),
        );
        const start = to - chosen.indexOf(id);
        expect(first).toBe(Math.max(0, Math.min(start, all.length - chosen.length)));
      }),
    );
  });
});

describe('what a group says of itself', () => {
  const frames = [
    {
      durationMs: 500,
      targets: [
        { servo: 1, position: 1000 },
        { servo: 2, position: 1500 },
      ],
    },
    { durationMs: 250, targets: [{ servo: 2, position: 1500 }] },
    {
      durationMs: 0,
      targets: [
        { servo: 2, position: 1600 },
        { servo: 1, position: 900 },
      ],
    },
  ];

  test('its total time is the sum of its frames', () => {
    expect(totalDurationMs(frames)).toBe(750);
  });

  test('a servo keeps its place until a later frame names it', () => {
    expect([...poseAt(frames, 1)]).toEqual([
      [1, 1000],
      [2, 1500],
    ]);
    expect(poseAt(frames, -1).size).toBe(0);
  });

  test('only servos that leave their place count as changed', () => {
    expect(changedServos(frames, 0)).toEqual([1, 2]);
    expect(changedServos(frames, 1)).toEqual([]);
    expect(changedServos(frames, 2)).toEqual([1, 2]);
  });
});
