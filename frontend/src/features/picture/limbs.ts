// The servos of a robot by limb, in the order in which the robot names them. Pure.

import type { RobotServo } from '#shared/profile/robot.ts';

export interface Limb {
  /** Empty for servos that belong to none. */
  readonly group: string;
  readonly servos: readonly RobotServo[];
}

export function limbsOf(servos: readonly RobotServo[]): readonly Limb[] {
  const groups = [...new Set(servos.map(({ group }) => group))];
  return groups.map((group) => ({ group, servos: servos.filter((servo) => servo.group === group) }));
}
