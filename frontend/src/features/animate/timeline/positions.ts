// Positions as the person reads them: in the units of the group, or in degrees where the robot at hand counts in the same. Pure.

import { servoOf } from '#shared/profile/robot.ts';
import { inUnits, scaleOf, type Scale } from '../../drive/scale.ts';
import { words } from '../../../i18n/words.ts';
import { rangeOf, type Desk } from './desk.ts';

export type Reader = Pick<Desk, 'robot' | 'family' | 'positionsIn'> & {
  readonly group: Pick<Desk['group'], 'unit'>;
};

export function scaleAt({ robot, family, group, positionsIn }: Reader, servo: number): Scale {
  const own = servoOf(robot, servo);
  return own !== undefined && group.unit === family.unit
    ? scaleOf(own, family, positionsIn)
    : inUnits(rangeOf({ robot, family }, servo), group.unit);
}

/** How far an arrow key turns the servo, in the group's units: by one of what is shown, as near as can be. */
export function nudgeUnits(reader: Reader, servo: number): number {
  return Math.max(1, Math.round(1 / unitsShown(reader, servo)));
}

export function turnText(reader: Reader, servo: number): string {
  const scale = scaleAt(reader, servo);
  const shown = nudgeUnits(reader, servo) * unitsShown(reader, servo);
  return scale.isDegrees
    ? words.numbers.formatDegrees(shown, scale.decimals)
    : words.position[reader.group.unit]({ position: shown });
}

/** What one unit of the group comes to where it is shown. */
function unitsShown(reader: Reader, servo: number): number {
  return scaleAt(reader, servo).isDegrees ? (servoOf(reader.robot, servo)?.degreesPerUnit ?? 1) : 1;
}
