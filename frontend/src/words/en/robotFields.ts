// What the fields of a robot's file take, for whoever writes such files.

import {
  BATTERY_KINDS,
  BATTERY_MV,
  BATTERY_POLICIES,
  BODIES,
  NAME_LENGTH,
} from '#shared/actions/robot/robot.ts';
import type { RobotField, ServoInList } from '#shared/actions/robot/robotShape.ts';
import { formatWhole } from './numbers.ts';

export function inList(servo: ServoInList | null): string {
  if (servo === null) return '';
  const place = formatWhole(servo.place);
  return servo.name.trim() === ''
    ? `number ${place} of the servos: `
    : `${servo.name} (number ${place} of the servos): `;
}

const MILLIVOLTS = `a whole number from ${formatWhole(BATTERY_MV.min)} to ${formatWhole(BATTERY_MV.max)}`;

export const FIELD_TAKES: Readonly<Record<RobotField, string>> = {
  robot: 'the description of a robot',
  name: `1 to ${formatWhole(NAME_LENGTH)} letters`,
  board: 'a board that is known here',
  body: `one of ${BODIES.join(', ')}`,
  servos: 'a list of 1 to 253 servos',
  battery: `one of ${BATTERY_KINDS.join(', ')}`,
  batteryCare: 'policy and thresholds',
  policy: `one of ${BATTERY_POLICIES.join(', ')}`,
  thresholds: 'warnMv and alarmMv, or null',
  warnMv: MILLIVOLTS,
  alarmMv: MILLIVOLTS,
  servo: 'a whole number from 1 to 253',
  group: `at most ${formatWhole(NAME_LENGTH)} letters`,
  min: 'a whole number',
  max: 'a whole number',
  home: 'a whole number',
  trim: 'a whole number',
  isReversed: 'true or false',
  degreesPerUnit: 'a number above 0, 2 at most',
  mirror: 'the number of a servo, or null',
  place: 'x and y, each a whole number from 0 to 100',
};
