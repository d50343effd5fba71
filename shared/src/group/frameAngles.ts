// The angles that compiled frames turn the joints of a robot to, and when: for estimates on its model. The way to the first pose is left
// out, because where the robot comes from is not known. Knows no geometry.

import type { Frame } from '../codec/commands.ts';
import { degreesOf, servoOf, type Robot } from '../profile/robot.ts';

const RADIANS = Math.PI / 180;

/** Milliseconds from the beginning of the group, radians by servo. Servos that no frame has moved so far are at home. */
export function frameAngles(
  frames: readonly Frame[],
  robot: Robot,
): readonly { readonly atMs: number; readonly angles: ReadonlyMap<number, number> }[] {
  let atMs = 0;
  let angles: ReadonlyMap<number, number> = new Map();
  return frames.map(({ durationMs, targets }) => {
    const turned = targets.flatMap(({ servo: number, position }) => {
      const servo = servoOf(robot, number);
      return servo === undefined ? [] : [[number, degreesOf(servo, position) * RADIANS] as const];
    });
    atMs += durationMs;
    angles = new Map([...angles, ...turned]);
    return { atMs, angles };
  });
}
