// What ready robots, their servos and their limbs are called.

import type { ReadyRobotId, RobotNames } from '#shared/profile/readyRobots.ts';
import { words } from '../words.ts';

/** What a ready robot and its parts are called when it is added. */
export function robotNames(id: ReadyRobotId): RobotNames {
  return {
    robot: words.robots.readyNames[id],
    role: (role, servo) => (role === 'servo' ? words.servos.name({ servo }) : words.robots.roles[role]),
    limb: (limb) => words.robots.limbs[limb],
  };
}
