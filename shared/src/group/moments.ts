// A group's frames as moments on the clock, and back: edits that move things in time do so here, where no frame depends on the
// one before it; and keys that change frames, which come in as before. Knows nothing between two keys.

import { sortedTargets } from '../codec/commands.ts';
import type { ActionGroup, GroupFrame, KeyTarget } from './group.ts';
import { sameEasing, type Easing } from './curves.ts';
import { changed, sameList, sameOwnEasing, samePose } from './groupEdits.ts';

export interface Moment {
  readonly atMs: number;
  /** Its `durationMs` is the one it had; it gets its own when the moments become frames again. */
  readonly frame: GroupFrame;
}

/** As much as one frame can take. */
const LONGEST_MS = 0xffff;
/** Numbered when the moments become frames. */
const UNNUMBERED = 0;

export function momentsOf({ frames }: ActionGroup): readonly Moment[] {
  let atMs = 0;
  return frames.map((frame) => ({ atMs: (atMs += frame.durationMs), frame }));
}

/** What is not said of its frame is plain: without note and colour. */
export function newMoment(
  atMs: number,
  targets: readonly KeyTarget[],
  look: Pick<GroupFrame, 'easing'> & Partial<Pick<GroupFrame, 'note' | 'colour'>>,
): Moment {
  return { atMs, frame: { id: UNNUMBERED, durationMs: 0, targets, note: '', colour: null, ...look } };
}

/** No time is before the beginning, and each is a whole millisecond. */
export const wholeMs = (atMs: number): number => Math.max(0, Math.round(atMs));

/**
 * The group with these moments, in whatever order, and otherwise as it was or as `change` says. What is the same stays the very
 * same object, the group too. Where they are farther apart than a frame can be long, frames without keys fill the time.
 */
export function withMoments(
  group: ActionGroup,
  moments: readonly Moment[],
  change: Partial<Pick<ActionGroup, 'markers' | 'unit' | 'blocks'>> = {},
): ActionGroup {
  const before = new Map(group.frames.map((frame) => [frame.id, frame]));
  const frames: GroupFrame[] = [];
  let nextId = moments.reduce((next, { frame }) => Math.max(next, frame.id + 1), group.nextId);
  let lastMs = 0;
  const add = (frame: GroupFrame, durationMs: number): void => {
    if (frame.durationMs === durationMs && frame === before.get(frame.id)) return void frames.push(frame);
    const id = frame.id === UNNUMBERED ? nextId++ : frame.id;
    frames.push(sameFrame(before.get(id), { ...frame, id, durationMs }));
  };
  for (const { atMs, frame } of moments.toSorted((one, other) => one.atMs - other.atMs)) {
    for (; atMs - lastMs > LONGEST_MS; lastMs += LONGEST_MS)
      add(newMoment(0, [], { easing: frame.easing }).frame, LONGEST_MS);
    add(frame, atMs - lastMs);
    lastMs = atMs;
  }
  const markers = sameList(group.markers, change.markers ?? group.markers);
  return changed(group, { ...change, markers, nextId, frames: sameList(group.frames, frames) });
}

function sameFrame(before: GroupFrame | undefined, after: GroupFrame): GroupFrame {
  if (before === undefined) return after;
  if (before.targets !== after.targets && !samePose(before.targets, after.targets)) return after;
  return changed(before, { ...after, targets: before.targets });
}

/**
 * Puts keys at an instant: into the moment that is there, where they take the place of their servos' keys and come in as they would
 * in the one made of `made`, or into that one.
 */
export function placed(
  moments: readonly Moment[],
  atMs: number,
  targets: readonly KeyTarget[],
  made: (targets: readonly KeyTarget[]) => Moment,
): readonly Moment[] {
  const index = moments.findLastIndex((moment) => moment.atMs === atMs);
  const there = moments[index];
  if (there === undefined) return [...moments, { ...made(targets), atMs }];
  const arriving = carried(targets, made(targets).frame.easing, there.frame.easing);
  return moments.with(index, withTargets(there, sortedTargets([...there.frame.targets, ...arriving])));
}

export function withTargets({ atMs, frame }: Moment, targets: readonly KeyTarget[]): Moment {
  return { atMs, frame: { ...frame, targets } };
}

/** Keys that leave a frame for one of another easing: each comes in as before. */
export function carried(targets: readonly KeyTarget[], from: Easing, to: Easing): readonly KeyTarget[] {
  if (sameEasing(from, to)) return targets;
  return targets.map((target) => withOwnEasing(target, target.easing ?? from, to));
}

/** In a frame that comes in so; the very same key where that changes nothing. */
export function withOwnEasing(target: KeyTarget, easing: Easing, frameEasing: Easing): KeyTarget {
  const own = sameEasing(easing, frameEasing) ? undefined : easing;
  if (sameOwnEasing(target.easing, own)) return target;
  const { servo, position } = target;
  return own === undefined ? { servo, position } : { servo, position, easing: own };
}
