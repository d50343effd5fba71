// The same robot as it would count in the other unit, by the rescale that others use between pulse widths and steps (boards.md
// chapter 7): steps = (µs − 500) ÷ 2. For drawing what was made for another board and for converting it, so that a pose looks
// alike before and after. Pure.

import { FAMILIES, UNKNOWN_BOARD, type Family, type FamilyId } from '../codec/families.ts';
import type { Robot, RobotServo } from './robot.ts';

// The same robot and the same group as they would count in the other unit, by the rescale that others use between
// pulse widths and steps (boards.md chapter 7): steps = (µs − 500) ÷ 2. For drawing what was made for another board,
// and for converting it, so that a pose looks alike before and after. A group holds no ranges of the robot it was
// made for, so angles would have no beginning.

type Unit = Family['unit'];

const PULSE_AT_0 = 500;
const PULSE_PER_STEP = 2;

/** Unrounded, below 0 where no step is so low. */
export function rescaled(position: number, from: Unit, to: Unit): number {
  if (from === to) return position;
  return to === 'steps' ? (position - PULSE_AT_0) / PULSE_PER_STEP : position * PULSE_PER_STEP + PULSE_AT_0;
}

/** The first board of the table that counts like that: any would do. */
export const familyOfUnit = (unit: Unit): Family =>
  Object.values(FAMILIES).find((family) => family.unit === unit) ?? UNKNOWN_BOARD;

const counterparts = new WeakMap<Robot, Robot>();

/** The very same where it counts so already, and the very same each time. */
export function robotInUnit(robot: Robot, unit: Unit): Robot {
  const { unit: own } = FAMILIES[robot.board];
  if (own === unit) return robot;
  const known = counterparts.get(robot);
  if (known !== undefined) return known;
  const at = (position: number): number => Math.max(0, Math.round(rescaled(position, own, unit)));
  const per = Math.abs(rescaled(1, own, unit) - rescaled(0, own, unit));
  const servos = robot.servos.map((servo): RobotServo => ({
    ...servo,
    ...{ min: at(servo.min), max: at(servo.max), home: at(servo.home) },
    trim: Math.round(servo.trim * per),
    degreesPerUnit: servo.degreesPerUnit / per,
  }));
  const made: Robot = { ...robot, board: familyOfUnit(unit).id as FamilyId, servos };
  counterparts.set(robot, made);
  return made;
}
