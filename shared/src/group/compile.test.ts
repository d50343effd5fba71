import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { Frame } from '../codec/commands.ts';
import { encodeCommand } from '../codec/encode.ts';
import { FAMILIES, family } from '../codec/families.ts';
import { readyRobot, type RobotNames } from '../profile/readyRobots.ts';
import { compile } from './compile.ts';
import { rangeOf, type CompileOptions, type CompileProblem } from './compileReport.ts';
import { EASINGS, type Easing } from './curves.ts';
import { emptyGroup, totalDurationMs, type ActionGroup } from './group.ts';
import { insertFrame } from './groupEdits.ts';
import { ANY_EASING, someGroup } from '../testing/groups.ts';
import { positionAt, tracksOf } from './tracks.ts';

const DOC = family('doc');
const TICK_MS = 20;
/** Where a servo may be whose position is unknown. */
const ANYWHERE = -5000;
const onTicks = fc.integer({ min: 1, max: 60 }).map((ticks) => ticks * TICK_MS);
const OVERSHOOT = [0.34, 1.56, 0.64, 1] as const;
const SMOOTH = ANY_EASING.filter((easing) => easing !== 'hold');
const NAMES: RobotNames = { robot: 'Mine', role: (role, servo) => `${role} ${servo}`, limb: (limb) => limb };
/** Fast enough for anything: what servos can follow is another matter. */
const FREE = { family: DOC, degreesPerS: Infinity };

type Row = readonly [durationMs: number, targets: Readonly<Record<number, number>>, easing?: Easing];

function groupOf(rows: readonly Row[], unit: ActionGroup['unit'] = 'us') {
  return rows.reduce(
    (group, [durationMs, positions, easing = 'linear']) => {
      const targets = Object.entries(positions).map(([servo, position]) => ({
        servo: Number(servo),
        position,
      }));
      return insertFrame(group, group.frames.length, { durationMs, targets, easing });
    },
    emptyGroup('Wave', unit),
  );
}

/** Where the frames have a servo: straight from one target to the next. */
function positionIn(frames: readonly Frame[], servo: number, atMs: number, start: number): number {
  let from = start;
  let fromMs = 0;
  for (const { durationMs, targets } of frames) {
    const to = targets.find((target) => target.servo === servo)?.position ?? from;
    if (atMs < fromMs + durationMs) return from + ((to - from) * (atMs - fromMs)) / durationMs;
    from = to;
    fromMs += durationMs;
  }
  return from;
}

const kindsOf = (problems: readonly CompileProblem[]) => problems.map(({ kind }) => kind);

describe('a compiled group', () => {
  test('is the group itself where each frame is a whole pose, straight and in the time of the board', () => {
    const simple = someGroup({ isFull: true, easings: ['linear'], durationMs: onTicks });
    fc.assert(
      fc.property(simple, fc.integer({ min: 0, max: 50 }), (group, maxErrorUnits) => {
        const { frames, report } = compile(group, { ...FREE, maxErrorUnits });
        expect(frames).toEqual(group.frames.map(({ durationMs, targets }) => ({ durationMs, targets })));
        expect(report).toMatchObject({ worst: null, shiftedMs: 0, problems: [], frameCount: frames.length });
      }),
    );
  });

  test('has every servo where the group has it, within the bound', () => {
    const smooth = someGroup({ easings: SMOOTH, durationMs: onTicks });
    const starts = fc.constantFrom(undefined, new Map([1, 2, 3].map((servo) => [servo, 1000])));
    fc.assert(
      fc.property(smooth, fc.integer({ min: 1, max: 60 }), starts, (group, maxErrorUnits, start) => {
        const { frames, report } = compile(group, { ...FREE, maxErrorUnits, ...(start && { start }) });
        let worst = 0;
        for (const track of tracksOf(group).values()) {
          const begun = start?.get(track.servo);
          for (let atMs = 0; atMs <= totalDurationMs(group.frames); atMs += 7) {
            const wanted = positionAt(track, atMs, begun);
            if (wanted === null) continue;
            const got = positionIn(frames, track.servo, atMs, begun ?? ANYWHERE);
            worst = Math.max(worst, Math.abs(got - wanted));
          }
        }
        expect(report.shiftedMs).toBe(0);
        expect(worst).toBeLessThanOrEqual((report.worst?.units ?? 0) + 1e-6);
        const own = report.problems.filter(({ kind }) => kind !== 'swing');
        if (own.length === 0) expect(worst).toBeLessThanOrEqual(maxErrorUnits + 1e-5);
        else expect(own).toMatchObject([{ kind: 'deviation', units: report.worst!.units }]);
        expect(totalDurationMs(frames)).toBe(totalDurationMs(group.frames));
      }),
    );
  });

  test('has a servo that holds within the bound too, but for the last tick, in which it jumps', () => {
    const any = someGroup({ durationMs: onTicks });
    fc.assert(
      fc.property(any, fc.integer({ min: 1, max: 60 }), (group, maxErrorUnits) => {
        const { frames, report } = compile(group, { ...FREE, maxErrorUnits });
        let worst = 0;
        for (const track of tracksOf(group).values()) {
          const jumps = track.keys.filter(({ easing }) => easing === 'hold').map(({ atMs }) => atMs);
          for (let atMs = 0; atMs <= totalDurationMs(group.frames); atMs += 7) {
            const wanted = positionAt(track, atMs);
            if (wanted === null || jumps.some((endMs) => atMs > endMs - TICK_MS && atMs < endMs)) continue;
            worst = Math.max(worst, Math.abs(positionIn(frames, track.servo, atMs, ANYWHERE) - wanted));
          }
        }
        if (!kindsOf(report.problems).includes('deviation'))
          expect(worst).toBeLessThanOrEqual(maxErrorUnits + 1e-5);
      }),
    );
  });

  test.each(['doc', 'openarm-old', 'xarm', 'learm-esp32'] as const)(
    'has only frames that a %s takes',
    (id) => {
      const own = FAMILIES[id];
      const { min, max } = own.position;
      const any = someGroup({ positions: fc.integer({ min, max: (min + max) / 2 }) });
      fc.assert(
        fc.property(any, (group) => {
          const { frames, report } = compile(
            { ...group, unit: own.unit },
            { family: own, maxErrorUnits: 8, degreesPerS: Infinity },
          );
          fc.pre(frames.length > 0 && frames.length <= own.framesPerGroup);
          fc.pre(!kindsOf(report.problems).includes('swing'));
          let bytes = 0;
          for (const [frameIndex, frame] of frames.entries()) {
            expect(frame.durationMs % own.motion.tickMs).toBe(0);
            expect(frame.durationMs).toBeGreaterThanOrEqual(own.shortestMoveMs);
            const place = { slot: 1, frameCount: frames.length, frameIndex };
            const taking = own.commands.includes('download')
              ? own
              : { ...DOC, ...own, commands: DOC.commands };
            bytes += encodeCommand({ kind: 'download', ...place, frame }, taking).length;
          }
          expect(report.bytes).toBe(bytes);
          expect(
            kindsOf(report.problems).filter((kind) => kind !== 'deviation' && kind !== 'tooShort'),
          ).toEqual([]);
        }),
      );
    },
  );

  test('takes as few frames as the bound allows for a curve', () => {
    const rise = groupOf([
      [20, { 1: 1000 }],
      [1000, { 1: 2000 }, 'in'],
    ]);
    // A straight piece of a fifth misses the parabola by 1000 / 4 / 25 = 10.
    const durations = (maxErrorUnits: number) =>
      compile(rise, { ...FREE, maxErrorUnits }).frames.map(({ durationMs }) => durationMs);
    expect(durations(10)).toEqual([20, 200, 200, 200, 200, 200]);
    expect(durations(9.9)).toHaveLength(7);
    expect(durations(250)).toEqual([20, 1000]);
  });

  test('names a servo while it is under way, and each in the first frame', () => {
    const group = groupOf([
      [100, { 1: 1000, 2: 1000 }],
      [100, { 1: 1200 }],
      [100, { 3: 1500 }],
      [100, { 1: 1000, 2: 2000 }],
    ]);
    const { frames } = compile(group, { ...FREE, maxErrorUnits: 1 });
    expect(frames.map(({ targets }) => targets.map(({ servo, position }) => [servo, position]))).toEqual([
      [
        [1, 1000],
        [2, 1000],
        [3, 1500],
      ],
      [
        [1, 1200],
        [2, 1333],
      ],
      [
        [1, 1000],
        [2, 2000],
      ],
    ]);
    expect(frames.map(({ durationMs }) => durationMs)).toEqual([100, 100, 200]);
  });

  test('leaves out ends of frames that are not needed', () => {
    const line = groupOf([
      [100, { 1: 1000, 2: 1500 }],
      [100, { 1: 1100 }],
      [100, { 1: 1200 }],
      [100, { 2: 1500 }],
    ]);
    expect(compile(line, { ...FREE, maxErrorUnits: 1 }).frames.map(({ durationMs }) => durationMs)).toEqual([
      100, 200, 100,
    ]);
  });

  test('stays, then jumps in one tick where a servo holds', () => {
    const group = groupOf([
      [100, { 1: 1000 }],
      [1000, { 1: 2000 }, 'hold'],
    ]);
    expect(compile(group, { family: DOC, maxErrorUnits: 1 })).toMatchObject({
      frames: [
        { durationMs: 100, targets: [{ servo: 1, position: 1000 }] },
        { durationMs: 980, targets: [{ servo: 1, position: 1000 }] },
        { durationMs: 20, targets: [{ servo: 1, position: 2000 }] },
      ],
      report: { problems: [] },
    });
  });

  test('goes straight to a first key to which the way is unknown', () => {
    for (const easing of EASINGS)
      expect(compile(groupOf([[100, { 1: 1000 }, easing]]), { ...FREE, maxErrorUnits: 1 }).frames).toEqual([
        { durationMs: 100, targets: [{ servo: 1, position: 1000 }] },
      ]);
  });

  test('says where a curve swings past the end of a range, with the key and how far', () => {
    const group = groupOf([
      [1000, { 1: 500, 2: 1500 }],
      [3000, { 1: 1500, 2: 2450 }, OVERSHOOT],
    ]);
    const { report } = compile(group, { family: DOC, maxErrorUnits: 5 });
    expect(report.problems).toEqual([
      { kind: 'swing', servo: 2, frameId: 2, position: 2543, min: 500, max: 2500 },
    ]);
  });

  test('takes a time that is longer than a frame in several', () => {
    const group = groupOf([
      [1000, { 1: 1000 }],
      [65_000, {}],
      [500, { 1: 1500 }],
    ]);
    const { frames } = compile(group, { ...FREE, maxErrorUnits: 2 });
    expect(frames.map(({ durationMs }) => durationMs)).toEqual([1000, 30_000, 30_000, 5500]);
    const slow = family('xarm');
    expect(
      Math.max(...compile(group, { family: slow, maxErrorUnits: 2 }).frames.map((frame) => frame.durationMs)),
    ).toBe(3000);
  });

  test('begins where the servos stand, as far as that is known', () => {
    const group = groupOf([[1000, { 1: 2000, 2: 2000 }, 'out']]);
    const { frames } = compile(group, { ...FREE, maxErrorUnits: 260, start: new Map([[1, 1000]]) });
    expect(frames).toEqual([
      {
        durationMs: 1000,
        targets: [
          { servo: 1, position: 2000 },
          { servo: 2, position: 2000 },
        ],
      },
    ]);
    const fine = compile(group, { ...FREE, maxErrorUnits: 10, start: new Map([[1, 1000]]) }).frames;
    expect(fine).toHaveLength(5);
    expect(fine[0]!.targets).toEqual([
      { servo: 1, position: 1360 },
      { servo: 2, position: 2000 },
    ]);
  });
});

describe('what a group costs and what of it cannot be', () => {
  const still: readonly Row[] = [[1000, { 1: 1500 }]];
  const problemsOf = (
    rows: readonly Row[],
    options: Partial<CompileOptions> = {},
    unit?: ActionGroup['unit'],
  ) => compile(groupOf(rows, unit), { family: DOC, maxErrorUnits: 2, ...options }).report.problems;
  const HUMANOID = readyRobot('humanoid16', 'lsc-16', NAMES);
  const tight = {
    ...HUMANOID,
    servos: HUMANOID.servos.map((servo) => ({
      ...servo,
      min: 1000,
      max: 2000,
      trim: 20,
      degreesPerUnit: 0.5,
    })),
  };
  const many = Array.from({ length: 300 }, (_, index): Row => [40, { 1: index % 2 === 0 ? 1000 : 1030 }]);
  const crowd: Row = [500, Object.fromEntries(Array.from({ length: 7 }, (_, index) => [index + 1, 1500]))];

  test.each<[string, readonly CompileProblem[], readonly CompileProblem[]]>([
    ['nothing', problemsOf(still), []],
    ['another unit', problemsOf(still, {}, 'steps'), [{ kind: 'unit', group: 'steps', board: 'us' }]],
    [
      'a position beyond the board',
      problemsOf([[1000, { 1: 2600 }]]),
      [{ kind: 'position', servo: 1, frameId: 1, position: 2600, min: 500, max: 2500 }],
    ],
    [
      'a position beyond the robot',
      problemsOf([[1000, { 1: 999, 2: 2000 }]], { robot: tight }),
      [{ kind: 'position', servo: 1, frameId: 1, position: 999, min: 1000, max: 2000 }],
    ],
    [
      'a servo it has not',
      problemsOf([[1000, { 40: 1500 }]]),
      [{ kind: 'servo', servo: 40, min: 1, max: 32 }],
    ],
    [
      'too many servos',
      problemsOf([crowd], { family: family('openarm-new') }),
      [
        { kind: 'servo', servo: 7, min: 1, max: 6 },
        { kind: 'tooManyServos', frame: 0, count: 7, limit: 6 },
      ],
    ],
    ['too many frames', problemsOf(many), [{ kind: 'tooManyFrames', count: 300, limit: 255 }]],
    [
      'keys closer than a tick, and one in no time',
      problemsOf([
        [0, { 1: 1500 }],
        [100, { 1: 1510 }],
        [4, { 1: 1520 }],
      ]),
      [
        { kind: 'tooShort', servo: 1, frameId: 1, leastMs: 20 },
        { kind: 'tooShort', servo: 1, frameId: 2, leastMs: 20 },
      ],
    ],
    [
      'a way too fast',
      problemsOf([
        [1000, { 1: 1000 }],
        [100, { 1: 2000 }],
        [1000, { 1: 1000 }],
      ]),
      [{ kind: 'tooFast', servo: 1, atMs: 1100, degreesPerS: 900, limit: 300 }],
    ],
    [
      'a way too fast for this robot, at the steepest of its curve',
      problemsOf(
        [
          [1000, { 1: 1000 }],
          [1000, { 1: 1600 }, 'inOut'],
        ],
        { robot: tight, degreesPerS: 500, maxErrorUnits: 500 },
      ),
      [{ kind: 'tooFast', servo: 1, atMs: 2000, degreesPerS: 600, limit: 500 }],
    ],
  ])('%s', (_, problems, expected) => expect(problems).toEqual(expected));

  test('a servo may go where both robot and board let it, as the robot counts', () => {
    const wide = { ...tight, servos: tight.servos.map((servo) => ({ ...servo, min: 100, max: 2000 })) };
    expect(rangeOf(1, family('learm-esp32'), wide)).toEqual({ min: 480, max: 1480 });
    expect(rangeOf(1, DOC, tight)).toEqual({ min: 1000, max: 2000 });
    expect(rangeOf(1, family('xarm'))).toEqual({ min: 0, max: 1000 });
  });

  test('too many frames of whole poses are made fewer where that is no loss', () => {
    const line = Array.from({ length: 300 }, (_, index): Row => [40, { 1: 1000 + index }]);
    const { frames, report } = compile(groupOf(line), { ...FREE, maxErrorUnits: 1 });
    expect(frames).toHaveLength(2);
    expect(report.problems).toEqual([]);
  });

  test('a curve in less time than the board can follow is reported with servo, time and degrees', () => {
    const steep = groupOf([
      [20, { 1: 1000, 2: 1000 }],
      [40, { 2: 2000 }, 'in'],
    ]);
    const { report } = compile(steep, { ...FREE, maxErrorUnits: 5, robot: tight });
    expect(report.worst).toMatchObject({ servo: 2, units: 62.5, atMs: 30, degrees: 31.25 });
    expect(kindsOf(report.problems)).toEqual(['deviation']);
  });

  test('keys off the ticks are moved to them, and it says how far', () => {
    const { frames, report } = compile(
      groupOf([
        [333, { 1: 1000 }],
        [333, { 1: 1300 }],
      ]),
      { ...FREE, maxErrorUnits: 1 },
    );
    expect(frames.map(({ durationMs }) => durationMs)).toEqual([340, 320]);
    expect(report.shiftedMs).toBe(7);
  });

  test('a download is counted, where the board takes one', () => {
    const { report } = compile(groupOf([still[0]!, [500, { 1: 1600 }]]), { family: DOC, maxErrorUnits: 2 });
    expect(report).toMatchObject({ bytes: 26, frameCount: 2, frameLimit: 255, durationMs: 1500 });
    expect(
      compile(groupOf(still), { family: family('lsc-16'), maxErrorUnits: 2 }).report.downloadMs,
    ).toBeNull();
  });
});
