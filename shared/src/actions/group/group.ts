// An action group as a document: an immutable list of frames with a name. Knows no history, no storage, no session; what
// a board can take is judged where it is sent. Positions are in the unit the group was made for, never converted.

import type { Frame, ServoTarget } from '../../protocol/commands.ts';

/** `id` tells frames apart while they move about in the list; it means nothing outside the document. */
export interface GroupFrame extends Frame {
  readonly id: number;
}

export interface ActionGroup {
  readonly name: string;
  readonly unit: 'us' | 'steps';
  readonly frames: readonly GroupFrame[];
  /** The next unused frame id; ids are never used twice, so an undone frame comes back as itself. */
  readonly nextId: number;
}

export function emptyGroup(name: string, unit: ActionGroup['unit']): ActionGroup {
  return { name, unit, frames: [], nextId: 1 };
}

/** Nominal time of one pass, as the frames ask for it. */
export function totalDurationMs(frames: readonly Frame[]): number {
  return frames.reduce((sum, frame) => sum + frame.durationMs, 0);
}

/** The position of each servo once frame `index` is done: a servo keeps its place until a later frame names it. */
export function poseAt(frames: readonly Frame[], index: number): ReadonlyMap<number, number> {
  const pose = new Map<number, number>();
  for (const frame of frames.slice(0, index + 1)) {
    for (const target of frame.targets) pose.set(target.servo, target.position);
  }
  return pose;
}

/** Servos that frame `index` moves away from where the frames before it left them, in ascending order. */
export function changedServos(frames: readonly Frame[], index: number): readonly number[] {
  const before = poseAt(frames, index - 1);
  const targets = frames[index]?.targets ?? [];
  return targets
    .filter((target) => before.get(target.servo) !== target.position)
    .map((target) => target.servo)
    .sort((one, other) => one - other);
}

/** Targets in ascending servo order, each servo once; the last one given wins. */
export function sortedTargets(targets: readonly ServoTarget[]): readonly ServoTarget[] {
  const byServo = new Map(targets.map((target) => [target.servo, target]));
  return [...byServo.values()].sort((one, other) => one.servo - other.servo);
}
