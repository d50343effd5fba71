import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { clipGroup, copyFrames, copyKeys, duplicateKeys, pasteFrames, pasteKeys } from './clip.ts';
import { emptyGroup, type ActionGroup, type GroupFrame } from './group.ts';
import { insertFrame } from './groupEdits.ts';
import { refsOf, shapeOf, someGroup, someRefs, withGroup } from '../testing/groups.ts';
import { setKey } from './keyEdits.ts';

const STAY = { ripple: false };
const RIPPLE = { ripple: true };

describe('a clip', () => {
  test('pasted where it was taken changes nothing', () => {
    const spaced = someGroup({ durationMs: fc.integer({ min: 1, max: 900 }), least: 1 });
    fc.assert(
      fc.property(withGroup(spaced, someRefs), ([group, refs]) => {
        expect(duplicateKeys(group, refs, 0, STAY).group).toBe(group);
      }),
    );
  });

  test('brings its keys, as far apart as they were, into another group', () => {
    const spaced = someGroup({ durationMs: fc.integer({ min: 1, max: 900 }), least: 1 });
    fc.assert(
      fc.property(spaced, fc.integer({ min: 0, max: 5000 }), (group, atMs) => {
        const { group: there, problems } = pasteKeys(
          emptyGroup('Other', 'steps'),
          copyKeys(group, refsOf(group)),
          atMs,
          STAY,
        );
        const firstMs = Math.min(...shapeOf(group).flatMap(({ keys }) => keys.map((key) => key.atMs)));
        expect(problems).toEqual([]);
        expect(shapeOf(there)).toEqual(
          shapeOf(group).map(({ servo, keys }) => ({
            servo,
            keys: keys.map((key) => ({ ...key, atMs: key.atMs - firstMs + atMs })),
          })),
        );
        if (refsOf(group).length > 0) expect(there.unit).toBe('us');
      }),
    );
  });

  test('with ripple first makes room for itself', () => {
    const pose = (position: number) => ({ durationMs: 500, targets: [{ servo: 1, position }] });
    const group = [1000, 2000].reduce((sum, at) => insertFrame(sum, 9, pose(at)), emptyGroup('Wave', 'us'));
    const clip = copyKeys(group, refsOf(group));
    expect(shapeOf(pasteKeys(group, clip, 600, RIPPLE).group)[0]!.keys.map(({ atMs }) => atMs)).toEqual([
      500, 600, 1100, 1500,
    ]);
  });

  test('of another unit is refused, one beyond the limits is reported', () => {
    const one = setKey(emptyGroup('Wave', 'us'), 3, 100, 2400);
    const clip = copyKeys(one, refsOf(one));
    const steps = setKey(emptyGroup('Other', 'steps'), 1, 100, 500);
    expect(pasteKeys(steps, clip, 0, STAY)).toEqual({
      group: steps,
      problems: [{ kind: 'unit', clip: 'us', group: 'steps' }],
    });
    const rangeOf = () => ({ min: 600, max: 2000 });
    const { group, problems } = pasteKeys(one, clip, 500, { ...STAY, rangeOf });
    expect(group.frames).toHaveLength(2);
    expect(problems).toEqual([{ kind: 'position', servo: 3, position: 2400, min: 600, max: 2000 }]);
  });
});

describe('whole frames in a clip', () => {
  const spaced = someGroup({ durationMs: fc.integer({ min: 1, max: 900 }), least: 1 });
  const plain = ({ frames }: { frames: readonly GroupFrame[] }) => frames.map(({ id: _, ...frame }) => frame);
  const someIds = ({ frames }: ActionGroup) => fc.subarray(frames.map(({ id }) => id));

  test('come back one behind the other with all that was said of them, at any place', () => {
    fc.assert(
      fc.property(withGroup(spaced, someIds), fc.nat(8), ([group, chosen], at) => {
        const index = Math.min(at, group.frames.length);
        const { group: after, problems } = pasteFrames(group, copyFrames(group, chosen), index);
        const wanted = group.frames.filter(({ id }) => chosen.includes(id));
        expect(problems).toEqual([]);
        expect(plain({ frames: after.frames.slice(index, index + chosen.length) })).toEqual(
          plain({ frames: wanted }),
        );
        expect(after.frames.toSpliced(index, chosen.length)).toEqual(group.frames);
        expect(new Set(after.frames.map(({ id }) => id)).size).toBe(after.frames.length);
      }),
    );
  });

  test('are keys where they are pasted at an instant, and keys are frames with the time they took', () => {
    const pose = (position: number) => ({ durationMs: 500, targets: [{ servo: 1, position }], note: 'Look' });
    const group = [1000, 2000].reduce((sum, at) => insertFrame(sum, 9, pose(at)), emptyGroup('Wave', 'us'));
    const frames = copyFrames(group, [2]);
    expect(pasteKeys(group, frames, 1700, STAY).group.frames[2]).toMatchObject({
      ...{ durationMs: 700, note: 'Look', targets: [{ servo: 1, position: 2000 }] },
    });
    const keys = copyKeys(group, [{ frameId: 2, servo: 1 }]);
    expect(pasteFrames(group, keys, 0).group.frames[0]).toMatchObject({
      ...{ durationMs: 500, note: '', targets: [{ servo: 1, position: 2000 }] },
    });
  });

  test('are refused where they cannot be, and reported where the robot must not go', () => {
    const one = insertFrame(emptyGroup('Wave', 'us'), 0, {
      durationMs: 100,
      targets: [{ servo: 3, position: 2400 }],
    });
    const clip = copyFrames(one, [1]);
    const steps = setKey(emptyGroup('Other', 'steps'), 1, 100, 500);
    expect(pasteFrames(steps, clip, 0)).toEqual({
      group: steps,
      problems: [{ kind: 'unit', clip: 'us', group: 'steps' }],
    });
    expect(pasteFrames(emptyGroup('New', 'steps'), clip, 0).group.unit).toBe('us');
    expect(pasteFrames(one, clip, 0, { rangeOf: () => ({ min: 600, max: 2000 }) }).problems).toEqual([
      { kind: 'position', servo: 3, position: 2400, min: 600, max: 2000 },
    ]);
  });

  test('of nothing change nothing', () => {
    const group = emptyGroup('Wave', 'steps');
    const nothing = copyFrames(emptyGroup('', 'us'), []);
    expect(pasteFrames(group, nothing, 0).group).toBe(group);
    expect(clipGroup(nothing).frames).toEqual([]);
  });
});
