// New shapes from poses, as pure functions over targets: home, mirror, flip, blend. What left and right or a turn is, the
// robot's description says. Knows no book.
//
// Mirror: what one side does, the other does; a servo without a partner stays as it is. Flip: every servo stays on its side
// and turns as far from its home, the other way.

import { type ServoTarget, sortedTargets } from '../codec/commands.ts';
import { degreesOf, mirrored, positionOf, servoOf, type Robot, type RobotServo } from './robot.ts';

export interface Reshaped<T extends ServoTarget = ServoTarget> {
  readonly targets: readonly T[];
  /** Servos that would have had to go beyond their limits, and now stand at them. */
  readonly held: readonly RobotServo[];
}

/** Servos of a pose that the robot does not have, in ascending order: the pose was made for another one. */
export function unknownServos(robot: Robot, targets: readonly ServoTarget[]): readonly number[] {
  const servos = new Set(targets.map(({ servo }) => servo));
  return [...servos].filter((servo) => servoOf(robot, servo) === undefined).sort((one, other) => one - other);
}

export function homeTargets(robot: Robot): readonly ServoTarget[] {
  return sortedTargets(robot.servos.map(({ servo, home }) => ({ servo, position: home })));
}

export function mirroredTargets<T extends ServoTarget>(robot: Robot, targets: readonly T[]): Reshaped<T> {
  return reshaped(robot, targets, (from, at) => {
    const to = from.mirror === null ? undefined : servoOf(robot, from.mirror);
    return to === undefined
      ? { to: from, wanted: at, position: at }
      : { to, wanted: positionOf(to, degreesOf(from, at)), position: mirrored(from, to, at) };
  });
}

export function flippedTargets(robot: Robot, targets: readonly ServoTarget[]): Reshaped {
  return reshaped(robot, targets, (servo, at) => {
    const wanted = 2 * servo.home - at;
    return { to: servo, wanted, position: Math.min(servo.max, Math.max(servo.min, wanted)) };
  });
}

interface Turned {
  readonly to: RobotServo;
  readonly wanted: number;
  /** `wanted` within the limits. */
  readonly position: number;
}

/** Servos that the robot does not have stay as they are. */
function reshaped<T extends ServoTarget>(
  robot: Robot,
  targets: readonly T[],
  turn: (servo: RobotServo, at: number) => Turned,
): Reshaped<T> {
  const held: RobotServo[] = [];
  const turned = targets.map((target) => {
    const servo = servoOf(robot, target.servo);
    if (servo === undefined) return target;
    const { to, wanted, position } = turn(servo, target.position);
    if (wanted !== position) held.push(to);
    return { ...target, servo: to.servo, position };
  });
  return { targets: sortedTargets(turned), held };
}

/** On the way from `one` (0) to `other` (1), for the servos that both have. */
export function blended(
  one: readonly ServoTarget[],
  other: readonly ServoTarget[],
  share: number,
): readonly ServoTarget[] {
  const there = new Map(other.map(({ servo, position }) => [servo, position]));
  return one.flatMap(({ servo, position }) => {
    const to = there.get(servo);
    return to === undefined ? [] : [{ servo, position: Math.round(position + (to - position) * share) }];
  });
}

/** The same servos at the same places, in whatever order. */
export function sameTargets(one: readonly ServoTarget[], other: readonly ServoTarget[]): boolean {
  const there = new Map(other.map(({ servo, position }) => [servo, position]));
  return one.length === other.length && one.every(({ servo, position }) => there.get(servo) === position);
}
