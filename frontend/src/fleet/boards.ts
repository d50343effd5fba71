// What the fleet page knows of a board by its name: its family, the robot it usually drives, and what the battery's voltage means. Pure.

import { FAMILIES, UNKNOWN_BOARD, type Family, type FamilyId } from '#shared/codec/families.ts';
import { supplyOf } from '#shared/profile/battery.ts';
import { readyRobot, usualRobot } from '#shared/profile/readyRobots.ts';
import type { Robot } from '#shared/profile/robot.ts';
import type { FleetRobot } from '#shared/client/http.generated.ts';
import { robotNames } from '../i18n/sentences.ts';

const isFamily = (board: string): board is FamilyId => Object.hasOwn(FAMILIES, board);

/** Of a board that its gateway does not know yet, or that a newer Servodeck knows: the unknown one. */
export const familyOf = (board: string): Family => (isFamily(board) ? FAMILIES[board] : UNKNOWN_BOARD);

/** The robot that such boards usually drive: the fleet hears of names and limits, not of bodies. */
export function usualRobotOf(board: string): Robot {
  const known = isFamily(board) ? board : 'doc';
  const id = usualRobot(known);
  return readyRobot(id, known, robotNames(id));
}

/** With the names, limits and trims that its gateway holds it to; the gateway counts as its board does. */
export function robotOf({ board, limits }: FleetRobot): Robot {
  const usual = usualRobotOf(board);
  const own = new Map(
    limits.map(({ servo, name, min, max, trim }) => [
      servo,
      { name, trim, min: min - trim, max: max - trim },
    ]),
  );
  return { ...usual, servos: usual.servos.map((one) => ({ ...one, ...own.get(one.servo) })) };
}

/** By its robot; by the supply that such a robot usually has where it does not say. */
export function isBatteryLow({ board, lowBatteryMv, state }: FleetRobot): boolean {
  const batteryMv = state?.batteryMv ?? 0;
  return batteryMv > 0 && batteryMv <= (lowBatteryMv ?? supplyOf(usualRobotOf(board)).warnMv);
}
