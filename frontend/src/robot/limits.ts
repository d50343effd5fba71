// The sentence for targets that the robot must not reach: which servo, and what it may do.

import { refusedTarget, type LimitRefusal, type Robot } from '#shared/profile/robot.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { servoLabel } from '../i18n/sentences/servos.ts';
import { words } from '../i18n/words.ts';

/** null where every target is within its servo's limits. */
export function limitRefusal(robot: Robot, targets: readonly ServoTarget[]): string | null {
  const refused = refusedTarget(robot, targets);
  return refused === null ? null : refusalText(refused);
}

export const refusalText = ({ servo, position }: LimitRefusal): string =>
  words.refused({ name: servoLabel(servo), value: position, min: servo.min, max: servo.max });
