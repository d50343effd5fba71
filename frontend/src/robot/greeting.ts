// The pose that the simulated arm rises to for whoever opens the page: as far as this robot's limits let each joint. Pure.

import type { Robot } from '#shared/profile/robot.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';

/** Readable: every joint away from the line of its neighbour. */
const GREETING = [1200, 1500, 1950, 2050, 1150, 1500];

export function greetingOf({ servos }: Robot): readonly ServoTarget[] {
  return servos.flatMap(({ servo, min, max }) => {
    const position = GREETING[servo - 1];
    return position === undefined ? [] : [{ servo, position: Math.min(max, Math.max(min, position)) }];
  });
}
