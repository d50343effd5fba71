import { expect, test } from 'vitest';
import fc from 'fast-check';
import { FAMILIES } from '../codec/families.ts';
import { readyRobot } from '../profile/readyRobots.ts';
import { evenly } from '../testing/cases.ts';
import { compile } from './compile.ts';
import { emptyGroup } from './group.ts';
import { insertFrame } from './groupEdits.ts';
import { loadOf, staggered } from './load.ts';

const family = FAMILIES.doc;
const robot = readyRobot('arm', 'doc', { robot: 'Arm', role: (role) => role, limb: (limb) => limb });
const options = { robot, family, rangeMs: 700 };

const frame = (durationMs: number, ...positions: readonly (number | null)[]) => ({
  durationMs,
  targets: positions.flatMap((position, servo) =>
    position === null ? [] : [{ servo: servo + 1, position }],
  ),
});

test('a servo turns as fast as its way and the time of the frame say', () => {
  const { spans, servos } = loadOf(
    [frame(400, 1500, 1500), frame(500, 2000, null), frame(1000, 1000, 1600)],
    options,
  );
  expect(spans.map(({ fromMs, toMs }) => [fromMs, toMs])).toEqual([
    [400, 900],
    [900, 1900],
  ]);
  // 0.09 degrees a unit.
  expect(spans[0]?.speeds.get(1)).toBeCloseTo(90);
  expect(spans[0]?.speeds.has(2)).toBe(false);
  expect(spans[1]?.speeds.get(2)).toBeCloseTo(9);
  expect(servos.map(({ servo, fastest }) => [servo, Math.round(fastest)])).toEqual([
    [1, 90],
    [2, 9],
  ]);
});

test('what it can do is its whole range in the time of the soft limit', () => {
  const [one] = loadOf([frame(400, 1500), frame(700, 1600)], options).servos;
  expect(one?.limit).toBeCloseTo(180 / 0.7);
});

test('the first frame says nothing, because the way into it is not known', () => {
  expect(loadOf([frame(20, 2500)], options)).toMatchObject({
    spans: [],
    mostMa: 0,
    servos: [{ fastest: 0 }],
  });
  expect(loadOf([], options)).toEqual({ spans: [], servos: [], mostMa: 0 });
});

test('the current grows with the speed and with the servos that turn, and no servo takes more than its most', () => {
  const position = evenly(500, 2500).map(Math.round);
  fc.assert(
    fc.property(position, position, fc.integer({ min: 20, max: 3000 }), (from, to, durationMs) => {
      const most = (...frames: Parameters<typeof loadOf>[0]): number => loadOf(frames, options).mostMa;
      const one = most(frame(500, from, from), frame(durationMs, to, from));
      const both = most(frame(500, from, from), frame(durationMs, to, to));
      const slower = most(frame(500, from, from), frame(durationMs * 2, to, from));
      expect(both).toBeGreaterThanOrEqual(one);
      expect(slower).toBeLessThanOrEqual(one);
      expect(both).toBeLessThanOrEqual(2 * 510);
      expect(both - 20).toBeCloseTo(2 * (one - 20));
    }),
  );
});

/** Every servo of the arm from one end to the other and back, with a rest at each end. */
function swing(easing: 'inOut' | 'linear') {
  const pose = (position: number) => robot.servos.map(({ servo }) => ({ servo, position }));
  return [1500, 1000, 1000, 2000, 2000].reduce(
    (group, position, index) =>
      insertFrame(group, index, { durationMs: 600, targets: pose(position), easing }),
    emptyGroup('Swing', 'us'),
  );
}

test('servos that begin one after another take less current at once, as said', () => {
  const all = { ...options, maxErrorUnits: 5, isFree: () => true };
  const found = staggered(swing('inOut'), all);
  expect(found).not.toBeNull();
  const { group, beforeMa, afterMa, stepMs } = found!;
  expect(afterMa).toBeLessThan(beforeMa * 0.95);
  expect(stepMs).toBeGreaterThan(0);
  const { frames } = compile(group, all);
  expect(loadOf(frames, options).mostMa).toBe(afterMa);
});

test('where it would not help the group stays as it is', () => {
  const none = { ...options, maxErrorUnits: 5, isFree: () => false };
  expect(staggered(swing('inOut'), none)).toBeNull();
  expect(staggered(emptyGroup('Nothing', 'us'), { ...none, isFree: () => true })).toBeNull();
});
