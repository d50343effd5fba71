import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { FAMILIES } from '../codec/families.ts';
import { factsOf } from '../files/facts.ts';
import { frozen, refsOf, sampled, someGroup, someRefs, withGroup } from '../testing/groups.ts';
import { deleteBlock, duplicateBlock, makeBlock, setBlock, unpackBlock } from './blockEdits.ts';
import { flattened } from './flattened.ts';
import { blocksOf, endOfBlock, motionLengthMs, motionTracks, servosOf } from './blocks.ts';
import { compile } from './compile.ts';
import { convertGroup } from './frameEdits.ts';
import { copyKeys, pasteFrames, pasteKeys } from './clip.ts';
import {
  emptyGroup,
  flawOfGroup,
  groupFromText,
  groupToText,
  holdsMotion,
  type ActionGroup,
} from './group.ts';
import { insertFrame } from './groupEdits.ts';
import { timesOf } from './groupTimes.ts';
import { deleteTime, insertTime, scaleTime } from './timeEdits.ts';
import { positionAt, tracksOf } from './tracks.ts';

const SERVOS = [1, 2, 3, 4, 5, 6];
const spaced = someGroup({
  durationMs: fc.integer({ min: 1, max: 900 }),
  easings: ['linear', 'inOut', 'in'],
});
const scene = withGroup(spaced, someRefs);

type Row = readonly [durationMs: number, positions: Readonly<Record<number, number>>];

const groupOf = (...rows: readonly Row[]): ActionGroup =>
  rows.reduce<ActionGroup>(
    (group, [durationMs, positions], index) =>
      insertFrame(group, index, {
        durationMs,
        targets: Object.entries(positions).map(([servo, position]) => ({ servo: Number(servo), position })),
      }),
    emptyGroup('Wave', 'us'),
  );

/** Servo 1 nods between 1000 and 2000 while servo 2 goes its way. */
const NOD = groupOf([1000, { 1: 1000, 2: 500 }], [500, { 1: 2000 }], [500, { 1: 1000 }], [1000, { 2: 2500 }]);
const nodRefs = refsOf(NOD).filter(({ servo }) => servo === 1);
const withNod = frozen(makeBlock(NOD, nodRefs, 'Nod')!);
const nodId = blocksOf(withNod)[0]!.id;

const keysOf = (group: ActionGroup, servo: number) =>
  motionTracks(group)
    .get(servo)
    ?.keys.map(({ atMs, position }) => [atMs, position]);

/** A group of nothing else. */
const ONLY = makeBlock(NOD, refsOf(NOD), 'All')!;

describe('a group made only of blocks', () => {
  test('holds motion, and is no longer empty for anything that is put into it', () => {
    expect(ONLY.frames).toEqual([]);
    expect([ONLY, NOD, emptyGroup('New', 'us'), { ...ONLY, blocks: [] }].map(holdsMotion)).toEqual([
      ...[true, true, false, false],
    ]);
    const pose = { durationMs: 500, targets: [{ servo: 1, position: 400 }] };
    expect(insertFrame(ONLY, 0, pose, 'steps').unit).toBe('us');
    const steps = insertFrame(emptyGroup('Other', 'steps'), 0, pose);
    const clip = copyKeys(steps, refsOf(steps));
    const problems = [{ kind: 'unit', clip: 'steps', group: 'us' }];
    expect(pasteKeys(ONLY, clip, 0, { ripple: false })).toEqual({ group: ONLY, problems });
    expect(pasteFrames(ONLY, clip, 0)).toEqual({ group: ONLY, problems });
  });

  test('is listed as long as it lasts, with the pose in its middle', () => {
    const { durationMs, pose } = factsOf(ONLY, { updatedAtMs: 0, robot: '' });
    expect(durationMs).toBe(motionLengthMs(ONLY));
    expect(pose.map(({ servo }) => servo)).toEqual([1, 2]);
  });
});

describe('keys made into a block', () => {
  test('move as before, whichever they are, and so they do as keys again', () => {
    fc.assert(
      fc.property(scene, ([group, refs]) => {
        const made = makeBlock(group, refs, 'Part');
        expect(made === null).toBe(refs.length === 0);
        if (made === null) return;
        const before = sampled(tracksOf(group), SERVOS, 6000);
        const end = motionLengthMs(group);
        const [block] = blocksOf(made);
        expect(sampled(motionTracks(made), SERVOS, 6000)).toEqual(before);
        expect(motionLengthMs(made)).toBe(end);
        expect(flawOfGroup(made)).toBeNull();
        expect(sampled(tracksOf(flattened(made)), SERVOS, 6000)).toEqual(before);
        expect(sampled(tracksOf(unpackBlock(made, block!.id)), SERVOS, 6000)).toEqual(before);
        expect(blocksOf(unpackBlock(made, block!.id))).toEqual([]);
      }),
    );
  });

  test('come back from a file', () => {
    expect(groupFromText(groupToText(withNod))).toEqual({ value: withNod });
    const damaged = groupToText(withNod).replace('"atMs":500,"easing"', '"atMs":9999,"easing"');
    expect(groupFromText(damaged)).toMatchObject({ problem: { code: 'badValue' } });
  });

  test('leave the servos that are not in it', () => {
    expect(servosOf(blocksOf(withNod)[0]!)).toEqual([1]);
    expect(tracksOf(withNod).get(1)).toBeUndefined();
    expect(keysOf(withNod, 2)).toEqual([
      [1000, 500],
      [3000, 2500],
    ]);
  });
});

describe('a block', () => {
  test('repeats without a pause where it ends as it begins', () => {
    expect(keysOf(setBlock(withNod, nodId, { times: 2 }), 1)).toEqual([
      [1000, 1000],
      [1500, 2000],
      [2000, 1000],
      [2500, 2000],
      [3000, 1000],
    ]);
  });

  test('goes back to its beginning in the time of its first frame where it does not', () => {
    const rise = groupOf([400, { 1: 1000 }], [500, { 1: 2000 }]);
    const made = makeBlock(rise, refsOf(rise), 'Rise')!;
    expect(keysOf(setBlock(made, blocksOf(made)[0]!.id, { times: 2 }), 1)).toEqual([
      [400, 1000],
      [900, 2000],
      [1300, 1000],
      [1800, 2000],
    ]);
  });

  test('is as much faster as it says, and the group as long as it lasts', () => {
    const fast = setBlock(withNod, nodId, { speedPercent: 200, startMs: 2800 });
    expect(keysOf(fast, 1)).toEqual([
      [2800, 1000],
      [3050, 2000],
      [3300, 1000],
    ]);
    expect(motionLengthMs(fast)).toBe(3300);
    expect(timesOf(fast).lengthMs).toBe(3300);
    expect(timesOf(fast)).toBe(timesOf(fast));
  });

  test('takes its servos over and gives them back gently', () => {
    const base = groupOf([1000, { 1: 1200 }], [3000, { 1: 1800 }]);
    const made = makeBlock(
      groupOf([1000, { 1: 2400 }], [400, { 1: 600 }]),
      [
        { frameId: 1, servo: 1 },
        { frameId: 2, servo: 1 },
      ],
      'Hit',
    )!;
    const block = { ...blocksOf(made)[0]!, id: base.nextId, startMs: 2000, blendInMs: 300, blendOutMs: 300 };
    const group = { ...base, nextId: base.nextId + 1, blocks: [block] };
    const own = tracksOf(base).get(1)!;
    const track = motionTracks(group).get(1)!;
    expect(endOfBlock(block)).toBe(3000);
    expect(keysOf(group, 1)).toEqual([
      [1000, 1200],
      [2000, 1400],
      [2300, 2400],
      [2700, 600],
      [3000, 1600],
      [4000, 1800],
    ]);
    for (const atMs of [1000, 1500, 2000, 3000, 3500, 4000])
      expect(positionAt(track, atMs)).toBeCloseTo(positionAt(own, atMs)!, 0);
    expect(track.keys[2]?.easing).toBe('inOut');
  });

  test('that begins later counts where two have the same servo', () => {
    const two = duplicateBlock(withNod, nodId);
    const [, copy] = blocksOf(two);
    expect(copy).toMatchObject({ startMs: 2000, name: 'Nod' });
    const over = setBlock(two, copy!.id, { startMs: 1400 });
    expect(keysOf(over, 1)).toEqual([
      [1000, 1000],
      [1400, 1000],
      [1900, 2000],
      [2400, 1000],
    ]);
  });

  test('is compiled as its keys would be', () => {
    const options = { family: FAMILIES.doc, maxErrorUnits: 5 };
    const block = setBlock(withNod, nodId, { times: 3, startMs: 1500 });
    const { frames, report } = compile(block, options);
    expect(frames).toEqual(compile(flattened(block), options).frames);
    expect(report.problems).toEqual([]);
  });

  test('beyond the range is said with its own number', () => {
    const wide = groupOf([1000, { 1: 1000 }], [1000, { 1: 3000 }]);
    const made = makeBlock(wide, refsOf(wide), 'Wide')!;
    const { problems } = compile(made, { family: FAMILIES.doc, maxErrorUnits: 5 }).report;
    expect(problems).toMatchObject([{ kind: 'position', frameId: -blocksOf(made)[0]!.id, position: 3000 }]);
  });

  test('holds what it can and no more', () => {
    const most = setBlock(withNod, nodId, { times: 5000, speedPercent: 1, blendInMs: -5, startMs: -20 });
    expect(blocksOf(most)[0]).toMatchObject({ times: 100, speedPercent: 10, blendInMs: 0, startMs: 0 });
    expect(setBlock(withNod, nodId, { times: 1 })).toBe(withNod);
    expect(deleteBlock(withNod, 999)).toBe(withNod);
    expect(blocksOf(deleteBlock(withNod, nodId))).toEqual([]);
  });

  test('moves with time, and counts in the other unit', () => {
    const startOf = (group: ActionGroup) => blocksOf(group)[0]?.startMs;
    expect(startOf(insertTime(withNod, 500, 700))).toBe(1700);
    expect(startOf(deleteTime(withNod, { fromMs: 0, toMs: 300 }))).toBe(700);
    expect(blocksOf(scaleTime(withNod, 2))[0]).toMatchObject({ startMs: 2000, speedPercent: 50 });
    expect(keysOf(convertGroup(withNod, 'steps')!, 1)).toEqual([
      [1000, 250],
      [1500, 750],
      [2000, 250],
    ]);
  });
});
