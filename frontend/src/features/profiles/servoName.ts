// What a servo is called in sentences: with its limb, for both knees of a body are called Knee.

import { servoOf, type Robot } from '#shared/profile/robot.ts';
import { servoLabel } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';

/** For sentences about several of them. */
export const namesIn =
  (robot: Robot) =>
  (servo: number): string =>
    servoName(robot, servo);

/** By its number where the robot has no such servo. */
export function servoName(robot: Robot, servo: number): string {
  const own = servoOf(robot, servo);
  return own === undefined ? words.servos.name({ servo }) : servoLabel(own);
}
