// Edits of whole frames that leave their times alone: easing, note, colour, left and right. Pure functions, the very same object
// where nothing changes. What left and right is, the robot's description says.

import type { Colour } from '../document/colours.ts';
import { mirroredTargets } from '../profile/poseShapes.ts';
import type { Robot, RobotServo } from '../profile/robot.ts';
import type { ActionGroup, Easing, GroupFrame } from './group.ts';
import { changed, sameList, samePose } from './groupEdits.ts';

export function setEasing(group: ActionGroup, frameIds: readonly number[], easing: Easing): ActionGroup {
  return changeFrames(group, frameIds, (frame) => changed(frame, { easing }));
}

export function setNote(group: ActionGroup, frameId: number, note: string): ActionGroup {
  return changeFrames(group, [frameId], (frame) => changed(frame, { note }));
}

export function setColour(
  group: ActionGroup,
  frameIds: readonly number[],
  colour: Colour | null,
): ActionGroup {
  return changeFrames(group, frameIds, (frame) => changed(frame, { colour }));
}

export interface Mirrored {
  readonly group: ActionGroup;
  /** Servos that would have had to go beyond their limits, and now stand at them. */
  readonly held: readonly RobotServo[];
}

/** What one side does in these frames, the other does. */
export function mirror(group: ActionGroup, robot: Robot, frameIds: readonly number[]): Mirrored {
  const held = new Set<RobotServo>();
  const mirrored = changeFrames(group, frameIds, (frame) => {
    const shape = mirroredTargets(robot, frame.targets);
    for (const servo of shape.held) held.add(servo);
    return samePose(frame.targets, shape.targets) ? frame : { ...frame, targets: shape.targets };
  });
  return { group: mirrored, held: [...held] };
}

function changeFrames(
  group: ActionGroup,
  frameIds: readonly number[],
  change: (frame: GroupFrame) => GroupFrame,
): ActionGroup {
  const meant = new Set(frameIds);
  const frames = group.frames.map((frame) => (meant.has(frame.id) ? change(frame) : frame));
  return changed(group, { frames: sameList(group.frames, frames) });
}
