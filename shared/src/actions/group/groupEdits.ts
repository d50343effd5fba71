// Every change of an action group, as pure functions: (group, arguments) → group. An edit that changes nothing returns the
// very same object, so that a history can leave it out. Frames are named by id, places by index.

import type { Frame, ServoTarget } from '../../protocol/commands.ts';
import { sortedTargets, type ActionGroup, type GroupFrame } from './group.ts';

export function rename(group: ActionGroup, name: string): ActionGroup {
  return changed(group, { name });
}

/** What is said of the group as a whole. */
export type GroupMeta = Pick<ActionGroup, 'name' | 'tags' | 'slot' | 'times' | 'robot'>;

export function setMeta(group: ActionGroup, meta: Partial<GroupMeta>): ActionGroup {
  const tags = meta.tags ?? group.tags;
  return changed(group, { ...meta, tags: sameList(group.tags, tags) });
}

/** The very same object where nothing in `change` is different. */
export function changed<T extends object>(before: T, change: Partial<T>): T {
  const keys = Object.keys(change) as (keyof T)[];
  return keys.every((key) => change[key] === before[key]) ? before : { ...before, ...change };
}

/** The list as it was where its items are. */
export function sameList<T>(before: readonly T[], after: readonly T[]): readonly T[] {
  const isSame = before.length === after.length && before.every((item, index) => item === after[index]);
  return isSame ? before : after;
}

const PLAIN = { easing: 'linear', note: '', colour: null } as const;

/** What is not said of a frame is plain: linear, without note and colour. */
export type NewFrame = Frame & Partial<GroupFrame>;

/** Puts a new frame at `index` (clamped to the list's ends). An empty group takes the unit of its first frame. */
export function insertFrame(
  group: ActionGroup,
  index: number,
  frame: NewFrame,
  unit: ActionGroup['unit'] = group.unit,
): ActionGroup {
  const added: GroupFrame = {
    ...PLAIN,
    ...frame,
    id: group.nextId,
    targets: sortedTargets(frame.targets),
  };
  const at = Math.max(0, Math.min(index, group.frames.length));
  return {
    ...group,
    unit: group.frames.length === 0 ? unit : group.unit,
    nextId: group.nextId + 1,
    frames: group.frames.toSpliced(at, 0, added),
  };
}

export function deleteFrame(group: ActionGroup, id: number): ActionGroup {
  const frames = group.frames.filter((frame) => frame.id !== id);
  return frames.length === group.frames.length ? group : { ...group, frames };
}

/** Puts a copy right behind the frame. */
export function duplicateFrame(group: ActionGroup, id: number): ActionGroup {
  const index = indexOfFrame(group, id);
  const frame = group.frames[index];
  return frame === undefined ? group : insertFrame(group, index + 1, frame);
}

/** Takes the frame out and puts it back as number `index` of the resulting list (clamped). */
export function moveFrame(group: ActionGroup, id: number, index: number): ActionGroup {
  const from = indexOfFrame(group, id);
  const frame = group.frames[from];
  const to = Math.max(0, Math.min(index, group.frames.length - 1));
  if (frame === undefined || from === to) return group;
  return { ...group, frames: group.frames.toSpliced(from, 1).toSpliced(to, 0, frame) };
}

/** Replaces the frame's pose. */
export function setTargets(group: ActionGroup, id: number, targets: readonly ServoTarget[]): ActionGroup {
  const sorted = sortedTargets(targets);
  return changeFrame(group, id, (frame) =>
    samePose(frame.targets, sorted) ? frame : { ...frame, targets: sorted },
  );
}

/** -1 where there is no such frame. */
export function indexOfFrame(group: ActionGroup, id: number): number {
  return group.frames.findIndex((frame) => frame.id === id);
}

function changeFrame(group: ActionGroup, id: number, change: (frame: GroupFrame) => GroupFrame): ActionGroup {
  const index = indexOfFrame(group, id);
  const before = group.frames[index];
  if (before === undefined) return group;
  const after = change(before);
  return after === before ? group : { ...group, frames: group.frames.with(index, after) };
}

/** Both in ascending servo order. */
export function samePose(one: readonly ServoTarget[], other: readonly ServoTarget[]): boolean {
  return (
    one.length === other.length &&
    one.every(
      (target, index) => target.servo === other[index]?.servo && target.position === other[index].position,
    )
  );
}
