import { UNKNOWN_MOTION, type KnownBoard, type Motion } from './model.ts';
import { expect, test } from 'vitest';
import type { Command, Frame, ServoTarget } from '../codec/commands.ts';
import { family, type FamilyId } from '../codec/families.ts';
import { haltPlan } from './haltPlan.ts';
import { afterCommand } from './motion.ts';
import { afterEnd } from './reports.ts';

type Targets = readonly (readonly [servo: number, position: number])[];

function move(durationMs: number, ...targets: Targets): Extract<Command, { kind: 'move' }> {
  return { kind: 'move', durationMs, targets: targets.map(([servo, position]) => ({ servo, position })) };
}

const run = (slot: number): Command => ({ kind: 'run', slot, times: 1 });
const STOP: Command = { kind: 'stop' };

/** Servos 1 and 2 rest at 1000 from time 0 on. */
function plan(id: FamilyId, nowMs: number, ...left: readonly (readonly [atMs: number, command: Command])[]) {
  return planWith({}, id, nowMs, ...left);
}

function planWith(
  groups: Readonly<Record<number, readonly Frame[]>>,
  id: FamilyId,
  nowMs: number,
  ...left: readonly (readonly [atMs: number, command: Command])[]
) {
  const board: KnownBoard = { family: family(id), playedFrames: (slot) => groups[slot] ?? null };
  let motion: Motion = afterCommand(UNKNOWN_MOTION, move(20, [1, 1_000], [2, 1_000]), -1_000, board);
  for (const [atMs, command] of left) motion = afterCommand(motion, command, atMs, board);
  return haltPlan(motion, nowMs, board);
}

function targetOf(targets: readonly ServoTarget[] | undefined, servo: number): number | undefined {
  return targets?.find((target) => target.servo === servo)?.position;
}

test('at rest each servo is held where it is, and all is held', () => {
  const { hold, unheld } = plan('doc', 0);
  expect(hold).toEqual(move(20, [1, 1_000], [2, 1_000]));
  expect(unheld).toBeNull();
});

test('what has stood for long is left alone: a hold would only undo what nobody here has seen', () => {
  expect(plan('doc', 900).hold?.targets).toHaveLength(2);
  expect(plan('doc', 1_100)).toEqual({ hold: null, unheld: null });
});

test('what a known group may move is held while it runs, and for a while: a stop may be lost', () => {
  const groups = { 5: [{ durationMs: 9_000, targets: [{ servo: 1, position: 2_000 }] }] };
  const servosAt = (nowMs: number) =>
    planWith(groups, 'lsc-6', nowMs, [0, run(5)], [5_000, STOP]).hold?.targets.map(({ servo }) => servo);
  expect(servosAt(5_500)).toEqual([1, 2]);
  expect(servosAt(7_500)).toEqual([1]);
});

test('a servo under way is held ahead of where it may be when the hold arrives, in a time for the way that is not sure', () => {
  const { hold, unheld } = plan('doc', 500, [0, move(1_000, [1, 2_000])]);
  // 27 ms later, and one tick and what the board says ahead.
  expect(targetOf(hold?.targets, 1)).toBeGreaterThan(1_530);
  expect(targetOf(hold?.targets, 1)).toBeLessThan(1_600);
  expect(hold?.durationMs).toBeGreaterThan(20);
  expect(hold?.durationMs).toBeLessThan(120);
  expect(unheld).toBeNull();
});

test('a hold goes no farther than the target', () => {
  expect(targetOf(plan('doc', 970, [0, move(1_000, [1, 2_000])]).hold?.targets, 1)).toBe(2_000);
});

test('where a fast move is not sure by half the range, the hold is slow and says so', () => {
  const { hold, unheld } = plan('doc', 0, [0, move(40, [1, 2_400])]);
  expect(hold?.durationMs).toBeGreaterThan(800);
  expect(unheld?.servos).toEqual([1]);
  expect(unheld?.forMs).toBeGreaterThan(700);
});

test.each([
  ['doc', 1_000],
  ['lsc-6', 20],
] as const)('%s does not hurry a servo that is in its first move (S26)', (id, leastMs) => {
  const { hold, unheld } = plan(id, 500, [0, move(1_500, [3, 2_000])]);
  expect(hold?.targets).toEqual(move(0, [1, 1_000], [2, 1_000]).targets);
  expect(hold?.durationMs).toBeGreaterThanOrEqual(leastMs === 20 ? 20 : 960);
  expect(unheld?.servos).toEqual([3]);
  expect(unheld?.forMs).toBeGreaterThanOrEqual(1_000);
});

test('is impossible while nothing is known', () => {
  const board: KnownBoard = { family: family('doc'), playedFrames: () => null };
  expect(haltPlan(UNKNOWN_MOTION, 0, board)).toEqual({ hold: null, unheld: null });
});

test('behind an unknown group its frame may go on, also when the group has been stopped', () => {
  for (const left of [
    [[0, run(7)]],
    [
      [0, run(7)],
      [300, STOP],
    ],
  ] as const) {
    const { hold, unheld } = plan('lsc-6', 1_000, ...left);
    expect(hold).toBeNull();
    expect(unheld?.servos).toBeNull();
    expect(unheld?.forMs).toBeGreaterThan(29_000);
  }
});

test.each([
  ['behind', [-500, run(77)], [0, move(10_000, [1, 2_000])]],
  ['ahead of', [-500, move(10_000, [1, 2_000])], [0, run(77)]],
] as const)(
  'a move %s a run of unknown frames is not held: they may have it elsewhere',
  (_, first, second) => {
    const { hold, unheld } = plan('doc', 1_000, first, second);
    expect(hold).toBeNull();
    expect(unheld?.servos).toBeNull();
    expect(unheld?.forMs).toBeGreaterThan(29_000);
  },
);

test.each([
  ['openarm-new', null],
  ['lsc-6', 77],
] as const)(
  '%s: the end of such a group leaves the places of its servos unknown, and nothing moves',
  (id, slot) => {
    const board: KnownBoard = { family: family(id), playedFrames: () => null };
    let motion: Motion = afterCommand(UNKNOWN_MOTION, move(20, [1, 1_000], [2, 1_000]), -1_000, board);
    motion = afterCommand(motion, run(77), 0, board);
    motion = afterCommand(motion, move(8_000, [1, 2_000]), 500, board);
    motion = afterEnd(motion, slot, 5_000, board);
    expect(haltPlan(motion, 6_000, board).hold).toBeNull();
    motion = afterCommand(motion, move(100, [2, 1_500]), 20_000, board);
    expect(haltPlan(motion, 21_000, board).hold?.targets).toEqual([{ servo: 2, position: 1_500 }]);
  },
);

test('a move behind the stop of such a group ends what the group has left under way, and is held', () => {
  const { hold, unheld } = plan('doc', 1_000, [0, run(77)], [100, STOP], [200, move(20, [1, 2_000])]);
  expect(hold).toEqual(move(20, [1, 2_000]));
  expect(unheld).toBeNull();
});

test('a run of an erased slot runs nothing', () => {
  const { unheld } = planWith({ 77: [] }, 'doc', 1_000, [-500, run(77)], [0, move(10_000, [1, 2_000])]);
  expect(unheld).toBeNull();
});

test('as many servos as two moves take, one behind the first stop and one behind the last: the others are said', () => {
  const near = Array.from({ length: 40 }, (_, index) => [index + 1, 200] as const);
  const far = near.map(([servo]) => [servo, 900] as const);
  const portions = (targets: Targets) => [targets.slice(0, 19), targets.slice(19, 38), targets.slice(38)];
  const { hold, unheld } = plan(
    'bus-ctrl',
    1_000,
    ...portions(near).map((some, index) => [index - 900, move(20, ...some)] as const),
    ...portions(far).map((some, index) => [index, move(9_000, ...some)] as const),
  );
  expect(hold?.targets).toHaveLength(19);
  expect(unheld?.servos).toEqual([39, 40]);
});

test('of LeArm only the base goes on: a stop halts the others (L9)', () => {
  const { unheld } = plan('learm-esp32', 300, [0, run(7)]);
  expect(unheld?.servos).toEqual([6]);
});

test('of a known group of LeArm the base goes on with a frame, no longer than the longest of them takes', () => {
  const frame = (durationMs: number, ...targets: Targets): Frame => ({
    durationMs,
    targets: move(durationMs, ...targets).targets,
  });
  const groups = {
    3: [frame(300, [1, 2_000]), frame(2_000, [1, 1_000], [6, 2_000])],
    4: [frame(300, [1, 2_000]), frame(2_000, [2, 2_000])],
  };
  expect(planWith(groups, 'learm-esp32', 1_000, [0, run(3)]).unheld?.servos).toEqual([6]);
  expect(planWith(groups, 'learm-esp32', 1_000, [0, run(3)]).unheld?.forMs).toBe(1_950);
  expect(planWith(groups, 'learm-esp32', 1_000, [0, run(4)]).unheld).toBeNull();
});

test('no hold is slower than a first move over the whole range, however little is sure', () => {
  const groups = { 5: [{ durationMs: 2, targets: [{ servo: 1, position: 504 }] }] };
  const { hold } = planWith(groups, 'openarm-old', 2_000, [0, { kind: 'run', slot: 5, times: 0 }]);
  expect(hold?.durationMs).toBeGreaterThan(1_000);
  expect(hold?.durationMs).toBeLessThanOrEqual(1_500);
});
