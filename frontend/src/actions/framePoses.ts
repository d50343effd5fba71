// The pose after each of some frames that follow each other, and which servos moved to get there, in one pass. Pure.

import type { Frame } from '#shared/protocol/commands.ts';
import { poseAt } from '#shared/actions/group/group.ts';

export interface FramePose {
  readonly pose: ReadonlyMap<number, number>;
  /** In ascending order. */
  readonly changed: readonly number[];
}

export function framePoses(frames: readonly Frame[], first: number, end: number): readonly FramePose[] {
  let before: ReadonlyMap<number, number> = poseAt(frames, first - 1);
  return frames.slice(first, end).map(({ targets }) => {
    const pose = new Map(before);
    for (const { servo, position } of targets) pose.set(servo, position);
    const known = before;
    const changed = [...pose.keys()].filter((servo) => known.get(servo) !== pose.get(servo));
    before = pose;
    return { pose, changed: changed.sort((one, other) => one - other) };
  });
}
