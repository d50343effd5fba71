// What a list says of a robot, worked out from it: its limits and poses as the board counts, for whoever moves it without
// knowing its trims. Knows no keeper's place.

import type { PoseBook } from '../profile/pose.ts';
import { homeTargets } from '../profile/poseShapes.ts';
import { limitsOnBoard, onBoard, type Robot } from '../profile/robot.ts';
import { FAMILIES } from '../codec/families.ts';
import type { RobotFacts } from './factsShape.ts';

const MAX_POSITION = 0xffff;

/** Home is number 0. */
export function robotFactsOf(robot: Robot, { poses }: PoseBook, updatedAtMs: number): RobotFacts {
  const home = { id: 0, name: 'home', unit: FAMILIES[robot.board].unit, targets: homeTargets(robot) };
  const all = [home, ...poses].map(({ id, name, unit, targets }) => ({
    ...{ id, name: name.toWellFormed(), unit },
    targets: onBoard(robot, targets).map(({ servo, position }) => ({ servo, position })),
  }));
  return {
    kind: 'robot',
    // Half a character, cut off at the length limit, could not be sent.
    name: robot.name.toWellFormed(),
    board: robot.board,
    updatedAtMs,
    limits: limitsOnBoard(robot).map((limits) => ({ ...limits, name: limits.name.toWellFormed() })),
    poses: all.filter(({ targets }) => targets.every(({ position }) => isSendable(position))),
  };
}

/** A trim may take a pose of another unit out of every board's range. */
const isSendable = (position: number): boolean => position >= 0 && position <= MAX_POSITION;
