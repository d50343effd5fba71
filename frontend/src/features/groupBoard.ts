// Which board a group is judged and drawn by: the one that is connected; while none is known, the one that the robot at hand is described
// for; and where the group counts in another unit, a board and a robot that count like it. Sends nothing.

import { familyOfUnit, robotInUnit } from '#shared/profile/units.ts';
import type { ActionGroup } from '#shared/group/group.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { FAMILIES, type Family } from '#shared/codec/families.ts';

export interface GroupBoard {
  readonly family: Family;
  readonly robot: Robot;
  /** The group was made for a board that counts otherwise than the known one. */
  readonly isOther: boolean;
}

export const knownFamily = (connected: Family, robot: Pick<Robot, 'board'>): Family =>
  connected.id === 'unknown' ? FAMILIES[robot.board] : connected;

export function boardOfGroup(
  { unit, frames }: Pick<ActionGroup, 'unit' | 'frames'>,
  family: Family,
  robot: Robot,
): GroupBoard {
  const isOther = frames.length > 0 && unit !== family.unit;
  return isOther
    ? { family: familyOfUnit(unit), robot: robotInUnit(robot, unit), isOther }
    : { family, robot, isOther };
}
