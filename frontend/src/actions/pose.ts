// The pose the robot was last asked for, as targets of a frame: only servos that were commanded, because nobody knows
// where the others are. Pure.

import type { ServoTarget } from '#shared/protocol/commands.ts';

export function commandedPose(targets: Readonly<Record<number, number>>): readonly ServoTarget[] {
  return Object.entries(targets).map(([servo, position]) => ({ servo: Number(servo), position }));
}
