// The board and robot that a group is checked and drawn with: the connected board; if none is known, the one of the current robot; for a
// group in another unit, a board and a robot in that unit. Sends nothing.

import { familyOfUnit, robotInUnit } from '#shared/profile/units.ts';
import type { ActionGroup } from '#shared/group/group.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { FAMILIES, type Family } from '#shared/codec/families.ts';

export interface GroupBoard {
  readonly family: Family;
  readonly robot: Robot;
  /** The group has another unit than the known board. */
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
