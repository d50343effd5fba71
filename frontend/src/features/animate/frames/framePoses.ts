// The pose after each of some frames that follow each other, and which servos moved to get there, in one pass. Pure.

import type { Frame } from '#shared/codec/commands.ts';
import { poseAt } from '#shared/group/group.ts';
import { sameLook, samePose } from '../../picture/pose.ts';

export interface FramePose {
  readonly pose: ReadonlyMap<number, number>;
  /** In ascending order. */
  readonly changed: readonly number[];
}

type Pose = FramePose['pose'];

interface Step {
  readonly from: Pose;
  readonly to: FramePose;
}

const known = new WeakMap<Frame, Step>();

/** The very same ones as before as long as they say the same: an edit of one frame has nothing done for dozens of others. */
export function framePoses(frames: readonly Frame[], first: number, end: number): readonly FramePose[] {
  let from: Pose = poseAt(frames, first - 1);
  return frames.slice(first, end).map((frame) => {
    const to = stepFrom(from, frame);
    from = to.pose;
    return to;
  });
}

function stepFrom(from: Pose, frame: Frame): FramePose {
  const before = known.get(frame);
  if (before !== undefined && samePose(before.from, from)) return before.to;
  const made = newStep(from, frame);
  const to = before !== undefined && sameLook(before.to, made) ? before.to : made;
  known.set(frame, { from, to });
  return to;
}

function newStep(from: Pose, { targets }: Frame): FramePose {
  const pose = new Map(from);
  for (const { servo, position } of targets) pose.set(servo, position);
  const changed = [...pose.keys()].filter((servo) => from.get(servo) !== pose.get(servo));
  return { pose, changed: changed.sort((one, other) => one - other) };
}
