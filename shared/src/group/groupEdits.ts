// Every change of an action group, as pure functions: (group, arguments) → group. An edit that changes nothing returns the
// very same object, so that a history can leave it out. Frames are named by id, places by index.

import { type Frame, type ServoTarget, sortedTargets } from '../codec/commands.ts';
import { sameEasing, type Easing } from './curves.ts';
import {
  GROUP_NAME_LENGTH,
  holdsMotion,
  type ActionGroup,
  type GroupFrame,
  type KeyTarget,
} from './group.ts';

/** As much of the name as one may be long. */
export function rename(group: ActionGroup, name: string): ActionGroup {
  return changed(group, { name: name.slice(0, GROUP_NAME_LENGTH) });
}

/** What is said of the group as a whole. */
export type GroupMeta = Pick<ActionGroup, 'name' | 'tags' | 'slot' | 'times' | 'robot' | 'maxErrorUnits'>;

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
    unit: holdsMotion(group) ? group.unit : unit,
    nextId: group.nextId + 1,
    frames: group.frames.toSpliced(at, 0, added),
  };
}

export function deleteFrames(group: ActionGroup, ids: readonly number[]): ActionGroup {
  const gone = new Set(ids);
  return changed(group, {
    frames: sameList(
      group.frames,
      group.frames.filter(({ id }) => !gone.has(id)),
    ),
  });
}

/** Puts new frames at `index`, in their order. */
export function insertFrames(group: ActionGroup, index: number, frames: readonly NewFrame[]): ActionGroup {
  return frames.reduce((sum, frame, offset) => insertFrame(sum, index + offset, frame), group);
}

/** Puts copies right behind the last of the frames, in their order. */
export function duplicateFrames(group: ActionGroup, ids: readonly number[]): ActionGroup {
  const wanted = new Set(ids);
  const isWanted = ({ id }: GroupFrame): boolean => wanted.has(id);
  return insertFrames(group, group.frames.findLastIndex(isWanted) + 1, group.frames.filter(isWanted));
}

/**
 * Takes the frames out and puts them back one behind the other, in their order: `lead`, one of them, becomes number `index` of the
 * resulting list, as far as its ends allow.
 */
export function moveFrames(
  group: ActionGroup,
  ids: readonly number[],
  lead: number,
  index: number,
): ActionGroup {
  const chosen = new Set(ids);
  const block = group.frames.filter(({ id }) => chosen.has(id));
  const place = block.findIndex(({ id }) => id === lead);
  if (place < 0) return group;
  const others = group.frames.filter(({ id }) => !chosen.has(id));
  const at = Math.max(0, Math.min(index - place, others.length));
  return changed(group, { frames: sameList(group.frames, others.toSpliced(at, 0, ...block)) });
}

/** Replaces the frame's pose; servos come in as before. */
export function setTargets(group: ActionGroup, id: number, targets: readonly ServoTarget[]): ActionGroup {
  return changeFrame(group, id, (frame) => {
    const own = new Map(frame.targets.map((target) => [target.servo, target]));
    const next = sortedTargets(targets).map((target) => ({ ...own.get(target.servo), ...target }));
    return samePose(frame.targets, next) ? frame : { ...frame, targets: next };
  });
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

/** Both in ascending servo order; how the servos come there too. */
export function samePose(one: readonly KeyTarget[], other: readonly KeyTarget[]): boolean {
  return (
    one.length === other.length &&
    one.every(
      (target, index) =>
        target.servo === other[index]?.servo &&
        target.position === other[index].position &&
        sameOwnEasing(target.easing, other[index].easing),
    )
  );
}

/** Of two keys; undefined: as their frame. */
export const sameOwnEasing = (one: Easing | undefined, other: Easing | undefined): boolean =>
  one === other || (one !== undefined && other !== undefined && sameEasing(one, other));
