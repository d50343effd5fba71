import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { evenly } from '#shared/testing/cases.ts';
import { readyRobot } from '#shared/profile/readyRobots.ts';
import { degreesOf, type RobotServo } from '#shared/profile/robot.ts';
import { robotNames } from '../../i18n/sentences.ts';
import { moveLinked, weightOf, type Member } from './useServoMoves.ts';

const servos = readyRobot('arm', 'doc', robotNames('arm')).servos;
const member = (servo: number, weight = 1, change: Partial<RobotServo> = {}): Member => ({
  servo: { ...servos[servo - 1]!, ...change },
  weight,
});
const targetsOf = (
  members: readonly Member[],
  moved: number,
  position: number,
  now: Record<number, number>,
) =>
  Object.fromEntries(
    moveLinked(members, moved, position, now, null).targets.map((target) => [target.servo, target.position]),
  );

describe('servos that move together', () => {
  test('turn by as many degrees as the one that is moved', () => {
    const finer = member(2, 1, { degreesPerUnit: 0.18 });
    expect(targetsOf([member(1), finer], 1, 1700, { 1: 1500, 2: 1000 })).toEqual({ 1: 1700, 2: 1100 });
  });

  test('turn in their own direction', () => {
    const reversed = member(2, 1, { isReversed: true });
    expect(targetsOf([member(1), reversed], 1, 1700, { 1: 1500, 2: 1000 })).toEqual({ 1: 1700, 2: 800 });
  });

  test('the others turn the other way when mirrored, each by its share when weighted', () => {
    expect([1, 2].map((servo) => weightOf('mirrored', {}, servo, 1))).toEqual([1, -1]);
    expect([1, 2].map((servo) => weightOf('weighted', { 2: -50 }, servo, 1))).toEqual([1, -0.5]);
    expect([1, 2].map((servo) => weightOf('straight', { 2: -50 }, servo, 1))).toEqual([1, 1]);
    expect(targetsOf([member(1), member(2, -0.5)], 1, 1700, { 1: 1500, 2: 1000 })).toEqual({
      1: 1700,
      2: 900,
    });
  });

  test('whichever of them is moved, the shares are the same', () => {
    expect(targetsOf([member(1), member(2, 0.5)], 2, 1100, { 1: 1500, 2: 1000 })).toEqual({
      1: 1700,
      2: 1100,
    });
  });

  test('a share of nothing holds a servo, and moves it alone', () => {
    expect(targetsOf([member(1), member(2, 0)], 1, 1700, { 1: 1500, 2: 1000 })).toEqual({ 1: 1700, 2: 1000 });
    expect(targetsOf([member(1), member(2, 0)], 2, 1700, { 1: 1500, 2: 1000 })).toEqual({ 2: 1700 });
  });

  test('all of them stop where the first one meets its limit', () => {
    const near = member(2, 1, { max: 1600 });
    expect(targetsOf([member(1), near], 1, 2000, { 1: 1000, 2: 1500 })).toEqual({ 1: 1100, 2: 1600 });
  });

  test('the servo that meets its limit first is reported, and none where all of them get there', () => {
    const members = [member(1), member(2, 1, { max: 1600 }), member(3, 1, { max: 1550 })];
    const first = (position: number) =>
      moveLinked(members, 1, position, { 1: 1000, 2: 1500, 3: 1500 }, null).first;
    expect(first(2000)).toBe(3);
    expect(first(1050)).toBeNull();
  });

  test('start from home where their positions are unknown', () => {
    expect(targetsOf([member(1), member(2)], 1, 1600, { 1: 1500 })).toEqual({ 1: 1600, 2: 1600 });
  });

  test('keep their stand over any number of small moves, and never leave their limits', () => {
    const positions = fc.array(fc.integer({ min: 500, max: 2500 }), { minLength: 1 });
    const weights = evenly(-2, 2);
    fc.assert(
      fc.property(positions, weights, (path, weight) => {
        const members = [member(1), member(2, weight, { min: 900, max: 1900 })];
        const start = { 1: 1500, 2: 1400 };
        let [now, linked]: [Record<number, number>, ReturnType<typeof moveLinked>['linked'] | null] = [
          start,
          null,
        ];
        for (const position of path) {
          const move = moveLinked(members, 1, position, now, linked);
          linked = move.linked;
          now = { ...linked.sent };
        }
        const turned = members.map(
          ({ servo }) =>
            degreesOf(servo, now[servo.servo]!) - degreesOf(servo, servo.servo === 1 ? 1500 : 1400),
        );
        expect(turned[1]!).toBeCloseTo(turned[0]! * weight, 0);
        expect(now[2]).toBeGreaterThanOrEqual(900);
        expect(now[2]).toBeLessThanOrEqual(1900);
      }),
    );
  });

  test('begin anew where something else moved one of them', () => {
    const members = [member(1), member(2)];
    const { linked } = moveLinked(members, 1, 1600, { 1: 1500, 2: 1000 }, null);
    expect(moveLinked(members, 1, 1700, { 1: 1600, 2: 2000 }, linked).targets).toEqual([
      { servo: 1, position: 1700 },
      { servo: 2, position: 2100 },
    ]);
  });
});
