// What is sold under its own name and built like a ready robot (boards.md section 9). Names of products are the same in every
// language.

import type { ReadyRobotId } from '#shared/profile/readyRobots.ts';

export const PRODUCTS: Partial<Readonly<Record<ReadyRobotId, string>>> = {
  arm: 'LeArm, OpenArm, xArm',
  hand: 'uHand',
  humanoid16: 'Tonybot',
  humanoid18: 'TonyPi',
  hexapod18: 'SpiderPi',
};
