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

test('a drag in small steps turns the joints in small steps', () => {
  const step = fc.constantFrom<Vec3>([1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]);
  fc.assert(
    fc.property(armAngles, step, (from, direction) => {
      const { tip } = poseOfChain(ARM, from);
      // A millimetre above its own base, or of a straight arm, is many degrees; elsewhere it is few.
      fc.pre(Math.hypot(tip[0], tip[1]) > 0.05 && Math.abs(from[2]) > 0.3);
      const { angles } = follow(ARM, from, { tip: added(tip, scaled(direction, 0.001)), rise: null });
      const farthest = Math.max(...angles.map((one, index) => Math.abs(one - (from[index] ?? 0))));
      expect(farthest).toBeLessThan(0.1);
    }),
    { numRuns: 500 },
  );
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
