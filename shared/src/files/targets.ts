// The servos of one frame as a file names them, brought into a group's order. Knows no format.

import type { ServoTarget } from '../codec/commands.ts';
import { sortedTargets } from '../group/group.ts';
import type { Remark } from './reading.ts';

/** In ascending servo order. Of a servo that is named twice the last position counts, and `remarks` gets it. */
export function targetsOf(
  named: readonly ServoTarget[],
  frame: number,
  remarks: Remark[],
): readonly ServoTarget[] {
  const targets = sortedTargets(named);
  if (targets.length < named.length) {
    const twice = named.find(({ servo }, index) => named.findIndex((one) => one.servo === servo) < index);
    remarks.push({ code: 'servoTwice', place: { frame }, found: String(twice?.servo) });
  }
  return targets;
}
