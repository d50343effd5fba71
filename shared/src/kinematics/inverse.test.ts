// Inverse kinematics against arms whose answer is known in closed form, and over all that an arm can reach.

import fc from 'fast-check';
import { expect, test } from 'vitest';
import {
  added,
  type Chain,
  type ChainJoint,
  lengthOf,
  minus,
  NO_ROTATION,
  poseOfChain,
  scaled,
  type Vec3,
} from './model.ts';
import { evenly } from '../testing/cases.ts';
import { flip, follow, reach } from './inverse.ts';

const HALF = Math.PI / 2;
const joint = (name: string, origin: Vec3, axis: Vec3, min = -HALF, max = HALF): ChainJoint => ({
  ...{ name, origin, axis, min, max },
  rotation: NO_ROTATION,
});

/** Straight up at 0: base about z, then three about y, as an arm of six servos has them. */
const ARM: Chain = {
  joints: [
    joint('base', [0, 0, 0.03], [0, 0, 1]),
    joint('shoulder', [0, 0, 0.04], [0, 1, 0]),
    joint('elbow', [0, 0, 0.104], [0, 1, 0]),
    joint('wrist', [0, 0, 0.089], [0, 1, 0]),
  ],
  tip: [0, 0, 0.15],
  pointing: [0, 0, 1],
};

const PLANAR: Chain = {
  joints: [joint('first', [0, 0, 0], [0, 0, 1], -3, 3), joint('second', [0.1, 0, 0], [0, 0, 1], -3, 3)],
  tip: [0.08, 0, 0],
  pointing: [1, 0, 0],
};

const angle = fc.double({ min: -HALF, max: HALF, noNaN: true });
const armAngles = fc.tuple(angle, angle, angle, angle);

test('two links in a plane end where the law of cosines puts them', () => {
  fc.assert(
    fc.property(
      fc.double({ min: 0.03, max: 0.175, noNaN: true }),
      fc.double({ min: -1.4, max: 1.4, noNaN: true }),
      (far, direction) => {
        const tip: Vec3 = [far * Math.cos(direction), far * Math.sin(direction), 0];
        const { angles, missM } = reach(PLANAR, [0, 0.5], { tip, rise: null });
        expect(missM).toBeLessThan(1e-3);
        const second = Math.acos((far ** 2 - 0.1 ** 2 - 0.08 ** 2) / (2 * 0.1 * 0.08));
        expect(Math.abs(angles[1] ?? 0)).toBeCloseTo(second, 1);
      },
    ),
  );
});

test('an arm reaches within 1 mm each place that it can reach, from where it rests', () => {
  fc.assert(
    fc.property(armAngles, (there) => {
      const { tip } = poseOfChain(ARM, there);
      expect(reach(ARM, [0, 0.3, 0.3, 0.3], { tip, rise: null }).missM).toBeLessThan(1e-3);
    }),
    { numRuns: 500 },
  );
});

test('level stays level where the tip can go there level', () => {
  fc.assert(
    fc.property(armAngles, ([base, shoulder, elbow]) => {
      const wrist = HALF - shoulder - elbow;
      fc.pre(Math.abs(wrist) <= HALF);
      const { tip, pointing } = poseOfChain(ARM, [base, shoulder, elbow, wrist]);
      expect(pointing[2]).toBeCloseTo(0, 9);
      const { angles, missM } = reach(ARM, [0, 0.5, 0.5, 0.5], { tip, rise: 0 });
      expect(missM).toBeLessThan(1e-3);
      expect(Math.abs(poseOfChain(ARM, angles).pointing[2])).toBeLessThan(0.01);
    }),
    { numRuns: 300 },
  );
});

test('no angle ever leaves its limits, wherever the tip is wished', () => {
  const place = fc.double({ min: -2, max: 2, noNaN: true });
  fc.assert(
    fc.property(armAngles, place, place, place, (from, x, y, z) => {
      const { angles } = reach(ARM, from, { tip: [x, y, z], rise: null });
      expect(angles.every((one) => one >= -HALF && one <= HALF)).toBe(true);
    }),
  );
});

test('out of reach it stretches towards the place', () => {
  const { angles, missM } = reach(ARM, [0, 0.3, 0.3, 0.3], { tip: [1, 0, 0.07], rise: null });
  const { tip } = poseOfChain(ARM, angles);
  expect(missM).toBeCloseTo(1 - 0.343, 3);
  expect(lengthOf(minus(tip, [0.343, 0, 0.07]))).toBeLessThan(2e-3);
});

/** Of the arm, from its shoulder to its tip. */
const LENGTH_M = 0.104 + 0.089 + 0.15 + 0.04;
/** What a joint turns at most for each radian by which the hand swings the whole limb. */
const MOST_TURN = 6;
const DEGREE = Math.PI / 180;

const farthest = (from: readonly number[], to: readonly number[]): number =>
  Math.max(...to.map((one, index) => Math.abs(one - (from[index] ?? 0))));

const direction = fc
  .tuple(evenly(-1, 1), evenly(-1, 1), evenly(-1, 1))
  .filter((way) => Math.hypot(...way) > 0.1)
  .map((way): Vec3 => scaled(way, 1 / Math.hypot(...way)));
/** Straight, nearly so, folded to a limit, or anything. */
const nearSingular = fc.oneof(
  fc.constant(0),
  evenly(-0.03, 0.03),
  fc.constantFrom(-HALF, HALF),
  evenly(-HALF, HALF),
);
const singularAngles = fc.tuple(evenly(-HALF, HALF), nearSingular, nearSingular, nearSingular);
/** As a hand goes: long and short ways in one direction or another, or out of reach. */
const handWays = fc.array(fc.record({ direction, m: fc.constantFrom(1e-4, 1e-3, 5e-3, 0.02, 0.3) }), {
  minLength: 1,
  maxLength: 12,
});
const rises = fc.constantFrom(null, 0);

test('near singular places, too, a drag turns no joint farther than the hand asks', () => {
  fc.assert(
    fc.property(singularAngles, handWays, rises, (start, ways, rise) => {
      let [angles, hand]: [readonly number[], Vec3] = [start, poseOfChain(ARM, start).tip];
      for (const { direction, m } of ways) {
        hand = added(hand, scaled(direction, m));
        const { angles: next } = follow(ARM, angles, { tip: hand, rise }, m);
        expect(farthest(angles, next)).toBeLessThanOrEqual((MOST_TURN * m) / LENGTH_M + 1e-9);
        angles = next;
      }
    }),
    { numRuns: 500 },
  );
});

test('a hand that rests turns nothing, however far the tip is from it', () => {
  fc.assert(
    fc.property(singularAngles, direction, (from, way) => {
      const wish = { tip: added(poseOfChain(ARM, from).tip, scaled(way, 0.05)), rise: null };
      expect(farthest(from, follow(ARM, from, wish, 0).angles)).toBeLessThan(1e-9);
    }),
  );
});

test('a bent elbow keeps its side through any drag', () => {
  const bend = fc.oneof(evenly(1.2 * DEGREE, 5 * DEGREE), evenly(1.2 * DEGREE, HALF));
  const side = fc.constantFrom(-1, 1);
  fc.assert(
    fc.property(singularAngles, bend, side, handWays, (others, bent, sign, ways) => {
      const start = others.map((one, index) => (index === 2 ? sign * bent : one));
      let [angles, hand]: [readonly number[], Vec3] = [start, poseOfChain(ARM, start).tip];
      for (const { direction, m } of ways) {
        hand = added(hand, scaled(direction, m));
        angles = follow(ARM, angles, { tip: hand, rise: null }, m).angles;
        expect(sign * (angles[2] ?? 0)).toBeGreaterThan(DEGREE);
      }
    }),
    { numRuns: 500 },
  );
});

test('away from singular places the tip stays with the hand', () => {
  const bend = fc.oneof(evenly(0.5, 1.2), evenly(-1.2, -0.5));
  const inside = evenly(-1.2, 1.2);
  const misses: number[] = [];
  fc.assert(
    fc.property(fc.tuple(inside, inside, bend, inside), direction, (from, way) => {
      const { tip } = poseOfChain(ARM, from);
      fc.pre(Math.hypot(tip[0], tip[1]) > 0.08);
      let angles: readonly number[] = from;
      for (let mm = 1; mm <= 10; mm++) {
        const wish = { tip: added(tip, scaled(way, mm / 1000)), rise: null };
        const found = follow(ARM, angles, wish, 1e-3);
        angles = found.angles;
        misses.push(found.missM);
      }
    }),
    { numRuns: 300 },
  );
  expect(misses.filter((miss) => miss < 1e-4).length / misses.length).toBeGreaterThan(0.9);
});

test('from the straight arm the first touch turns the base by as little as the rest, and the tip catches up', () => {
  const start = poseOfChain(ARM, [0, 0, 0, 0]).tip;
  const way = scaled([1, 1, -1.4], 1 / Math.hypot(1, 1, 1.4));
  let angles: readonly number[] = [0, 0, 0, 0];
  const misses: number[] = [];
  for (let mm = 2; mm <= 80; mm += 2) {
    const found = follow(ARM, angles, { tip: added(start, scaled(way, mm / 1000)), rise: null }, 2e-3);
    expect(farthest(angles, found.angles)).toBeLessThan(2 * DEGREE);
    angles = found.angles;
    misses.push(found.missM * 1000);
  }
  expect(Math.max(...misses)).toBeLessThan(8);
  expect(misses.at(-1)).toBeLessThan(0.1);
  expect(angles[0]).toBeCloseTo(Math.PI / 4, 2);
});

test('the other elbow leaves the tip where it is, and back again', () => {
  const angleOf = evenly(-HALF, HALF);
  const bent = fc.tuple(angleOf, angleOf, angleOf, angleOf);
  let flipped = 0;
  let returned = 0;
  fc.assert(
    fc.property(bent, (from) => {
      const { tip } = poseOfChain(ARM, from);
      const other = flip(ARM, from, null);
      if (other === null) return;
      flipped += 1;
      expect(lengthOf(minus(poseOfChain(ARM, other.angles).tip, tip))).toBeLessThan(1e-3);
      expect(other.angles.every((one) => one >= -HALF && one <= HALF)).toBe(true);
      const back = flip(ARM, other.angles, null);
      if (back === null) return;
      returned += 1;
      expect(Math.sign(other.angles[2] ?? 0)).toBe(-Math.sign(from[2]));
      expect(Math.sign(back.angles[2] ?? 0)).toBe(Math.sign(from[2]));
    }),
    { numRuns: 300 },
  );
  expect(flip(ARM, [0.3, 0.4, 0, 0], null)).toBeNull();
  expect(flipped).toBeGreaterThan(100);
  // Folded up to its limits an arm may find no way back.
  expect(returned / flipped).toBeGreaterThan(0.95);
});
