import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { Robot } from '#shared/profile/robot.ts';
import { readyRobot, type ReadyRobotId } from '#shared/profile/readyRobots.ts';
import { robotNames } from '../../i18n/sentences.ts';
import { bonesOf, type Point } from './bones.ts';
import { reachOf, roomFor } from './reach.ts';

const robot = (id: ReadyRobotId): Robot => readyRobot(id, 'lsc-24', robotNames(id));

/** Each servo anywhere within its limits, often at one of them. */
const poseOf = ({ servos }: Robot) =>
  fc
    .tuple(...servos.map(({ min, max }) => fc.oneof(fc.constantFrom(min, max), fc.integer({ min, max }))))
    .map((positions) => new Map(servos.map(({ servo }, index) => [servo, positions[index] ?? 0])));

function pointsOf(of: Robot, pose: ReadonlyMap<number, number>): readonly Point[] {
  const { trunk, bones } = bonesOf(of, (servo) => pose.get(servo) ?? null)!;
  return [...trunk, ...bones.flatMap(({ from, to }) => [from, to])];
}

describe('the reach of a body', () => {
  test.each(['humanoid16', 'humanoid18', 'hexapod18', 'hand'] as const)(
    'of %s holds any pose within the limits, and is little more',
    (id) => {
      const { left, top, right, bottom } = reachOf(robot(id))!;
      fc.assert(
        fc.property(poseOf(robot(id)), (pose) => {
          for (const { x, y } of pointsOf(robot(id), pose)) {
            expect(x).toBeGreaterThan(left);
            expect(x).toBeLessThan(right);
            expect(y).toBeGreaterThan(top);
            expect(y).toBeLessThan(bottom);
          }
        }),
      );
      expect(right - left).toBeLessThan(150);
      expect(bottom - top).toBeLessThan(156);
    },
  );

  test('in one pose is the square of the places, and more where that pose is wide', () => {
    const [own, wide] = [robot('hexapod18'), new Map([[1, 2500]])];
    const still = roomFor(bonesOf(robot('humanoid16'), (servo) => (servo > 0 ? 1500 : null))!);
    expect([still.left, still.top, still.right]).toEqual([0, 0, 100]);
    expect(roomFor(bonesOf(own, (servo) => wide.get(servo) ?? 1500)!).top).toBeLessThan(-20);
  });

  test('grows with the limits and the places', () => {
    const own = robot('hexapod18');
    const limited = { ...own, servos: own.servos.map((servo) => ({ ...servo, min: 1400, max: 1600 })) };
    expect(reachOf(limited)!.top).toBeGreaterThan(reachOf(own)!.top + 20);
  });

  test('of an arm and a plain robot is not by bones', () => {
    expect([robot('arm'), robot('plain16')].map(reachOf)).toEqual([null, null]);
  });
});
