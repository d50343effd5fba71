// One step of the end of a limb: along its line, within limits and speeds, or not at all.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import {
  type Chain,
  dot,
  lengthOf,
  minus,
  NO_ROTATION,
  poseOfChain,
  scaled,
  type Vec3,
} from '#shared/kinematics/model.ts';
import { readyRobot } from '#shared/profile/readyRobots.ts';
import { servoOf } from '#shared/profile/robot.ts';
import { evenly } from '#shared/testing/cases.ts';
import { robotNames } from '../../i18n/sentences.ts';
import { radiansOf } from '../picture/three/limbs.ts';
import { type Arm, tipStep } from './TipControls.tsx';

const ROBOT = readyRobot('arm', 'doc', robotNames('arm'));
/** Base, shoulder, elbow, wrist. */
const SERVOS = [6, 5, 4, 3];
const QUARTER = Math.PI / 2;
const joint = (name: string, z: number, axis: Vec3) => ({
  ...{ name, origin: [0, 0, z] as const, rotation: NO_ROTATION, axis, min: -QUARTER, max: QUARTER },
});
const CHAIN: Chain = {
  joints: [
    joint('base', 0.03, [0, 0, -1]),
    joint('shoulder', 0.045, [0, 1, 0]),
    joint('elbow', 0.104, [0, 1, 0]),
    joint('wrist', 0.089, [0, 1, 0]),
  ],
  tip: [0, 0, 0.145],
  pointing: [0, 0, 1],
};
const UNITS_PER_S = 2000 / 0.7;
const FRAME_MS = 16;

const PLACES = fc.tuple(
  ...[700, 900, 900, 900].map((least) => fc.integer({ min: least, max: 3000 - least })),
);
const DIRECTIONS = fc
  .tuple(evenly(-1, 1), evenly(-1, 1), evenly(-1, 1))
  .filter((way) => Math.hypot(...way) > 0.1)
  .map((way): Vec3 => scaled(way, 1 / Math.hypot(...way)));
const SPEEDS = fc.integer({ min: 5, max: 300 });

/** An arm that follows at once, at these positions. */
function armAt(positions: readonly number[], { isLevel = false, locked = [] as readonly number[] } = {}) {
  const targets = new Map(SERVOS.map((servo, index) => [servo, positions[index] ?? 1500]));
  let state: ReturnType<typeof tipStep>['state'] = null;
  const arm: Arm = {
    ...{ limb: { tip: 'grip', chain: CHAIN, servos: SERVOS }, robot: ROBOT, isLevel, unitsPerS: UNITS_PER_S },
    place(servo) {
      const at = targets.get(servo) ?? null;
      return { target: at, estimated: at };
    },
    isLocked: (servo) => locked.includes(servo),
  };
  return {
    targets,
    pose: () =>
      poseOfChain(
        CHAIN,
        SERVOS.map((number) => radiansOf(servoOf(ROBOT, number)!, targets.get(number) ?? 1500)),
      ),
    frame(speed: Vec3 | null) {
      const step = tipStep(arm, speed, FRAME_MS, state);
      state = step.state;
      for (const { servo, position } of step.moves) targets.set(servo, position);
      return step;
    },
  };
}

test('the tip goes along its line within a millimetre, and only forward', () => {
  fc.assert(
    fc.property(PLACES, DIRECTIONS, SPEEDS, (positions, direction, mmPerS) => {
      const arm = armAt(positions);
      const start = arm.pose().tip;
      for (let frame = 0; frame < 40; frame++) {
        arm.frame(scaled(direction, mmPerS));
        const gone = minus(arm.pose().tip, start);
        const along = dot(gone, direction);
        expect(lengthOf(minus(gone, scaled(direction, along)))).toBeLessThan(1e-3);
        expect(along).toBeGreaterThan(-1e-3);
        expect(along).toBeLessThan((mmPerS * (frame + 1) * FRAME_MS) / 1e6 + 1e-3);
      }
    }),
  );
});

test('no servo is sent beyond its limits or faster than it can turn', () => {
  fc.assert(
    fc.property(PLACES, DIRECTIONS, SPEEDS, (positions, direction, mmPerS) => {
      const arm = armAt(positions);
      for (let frame = 0; frame < 60; frame++) {
        const before = new Map(arm.targets);
        for (const { servo, position } of arm.frame(scaled(direction, mmPerS)).moves) {
          expect(position).toBeGreaterThanOrEqual(500);
          expect(position).toBeLessThanOrEqual(2500);
          const most = (UNITS_PER_S * FRAME_MS) / 1000 + 1;
          expect(Math.abs(position - (before.get(servo) ?? 0))).toBeLessThanOrEqual(most);
        }
      }
    }),
  );
});

test('near singular places, too, a stick turns no servo farther than it asks', () => {
  const near = fc.oneof(
    fc.constant(1500),
    fc.integer({ min: 1480, max: 1520 }),
    fc.integer({ min: 900, max: 2100 }),
  );
  const lengthM = 0.045 + 0.104 + 0.089 + 0.145;
  let moved = 0;
  fc.assert(
    fc.property(fc.tuple(near, near, near, near), DIRECTIONS, SPEEDS, (positions, direction, mmPerS) => {
      const arm = armAt(positions);
      const asked = (6 * mmPerS * FRAME_MS) / 1e6 / lengthM;
      for (let frame = 0; frame < 20; frame++) {
        const before = new Map(arm.targets);
        const { moves } = arm.frame(scaled(direction, mmPerS));
        moved += moves.length;
        for (const { servo, position } of moves) {
          // Half a unit before and half a unit behind: 2,000 units are half a turn.
          const most = (asked * 2000) / Math.PI + 1;
          expect(Math.abs(position - (before.get(servo) ?? 0))).toBeLessThanOrEqual(most);
        }
      }
    }),
  );
  expect(moved).toBeGreaterThan(1000);
});

test('beside the axis of its base the tip goes slowly, and does not stay', () => {
  const arm = armAt([1500, 1540, 1500, 1500]);
  const start = arm.pose().tip;
  for (let frame = 0; frame < 100; frame++) arm.frame([0, 50, 0]);
  expect(Math.abs((arm.targets.get(6) ?? 0) - 1500)).toBeGreaterThan(20);
  expect(minus(arm.pose().tip, start)[1]).toBeGreaterThan(5e-3);
});

describe('one arm', () => {
  const BENT = [1500, 1800, 1900, 1700];

  test('goes as far as it was pushed', () => {
    const arm = armAt(BENT);
    const start = arm.pose().tip;
    for (let frame = 0; frame < 50; frame++) arm.frame([0, 0, -50]);
    expect(minus(arm.pose().tip, start)[2]).toBeCloseTo(-0.04, 3);
  });

  test('sends nothing at rest, nor where it cannot go on', () => {
    const arm = armAt(BENT);
    expect(arm.frame(null)).toMatchObject({ moves: [], isShort: false });
    let last = arm.frame([200, 0, 0]);
    for (let frame = 0; frame < 200; frame++) last = arm.frame([200, 0, 0]);
    expect(last).toMatchObject({ moves: [], isShort: true });
    expect(arm.frame([-200, 0, 0])).toMatchObject({ isShort: false });
  });

  test('a locked servo stays, and the others take the tip along the line without it', () => {
    const arm = armAt(BENT, { locked: [3] });
    for (let frame = 0; frame < 20; frame++) arm.frame([0, 0, 40]);
    expect(arm.targets.get(3)).toBe(1700);
    expect(arm.targets.get(5)).not.toBe(1800);
  });

  test('a level end becomes level on the way and stays so', () => {
    const arm = armAt(BENT, { isLevel: true });
    for (let frame = 0; frame < 100; frame++) arm.frame([0, 0, -50]);
    expect(Math.abs(arm.pose().pointing[2])).toBeLessThan(0.03);
  });

  test('a servo that stands somewhere unknown is named, and nothing moves', () => {
    const arm = armAt(BENT);
    arm.targets.delete(4);
    expect(arm.frame([50, 0, 0])).toMatchObject({ moves: [], unknown: [4] });
  });

  test('begins where another client put it meanwhile', () => {
    const arm = armAt(BENT);
    for (let frame = 0; frame < 10; frame++) arm.frame([0, 0, 40]);
    arm.targets.set(6, 1200);
    const start = arm.pose().tip;
    arm.frame([0, 0, 40]);
    expect(lengthOf(minus(arm.pose().tip, start))).toBeLessThan(2e-3);
  });
});
