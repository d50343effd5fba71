// Keys or whole frames taken out of a group to be put into it again or into another one. A clip knows servos, positions and how far
// its keys are apart, not where it comes from. What cannot be pasted is said; nothing is changed to make it fit.

import type { ServoTarget } from '../codec/commands.ts';
import type { Range } from '../codec/families.ts';
import { emptyGroup, holdsMotion, MAX_FRAMES, type ActionGroup, type GroupFrame } from './group.ts';
import { changed, insertFrames } from './groupEdits.ts';
import { lifted } from './keyRanges.ts';
import { momentsOf, newMoment, placed, wholeMs, withMoments, type Moment } from './moments.ts';
import { insertTime, type Ripple } from './timeEdits.ts';
import type { KeyRef } from './tracks.ts';

export interface Clip {
  readonly unit: ActionGroup['unit'];
  /** How long the way to the first one took. */
  readonly leadMs: number;
  /** The first one at 0. */
  readonly moments: readonly ClipMoment[];
}

type ClipMoment = Pick<GroupFrame, 'easing' | 'note' | 'colour' | 'targets'> & { readonly atMs: number };

export type PasteProblem =
  /** Nothing was pasted. */
  | { readonly kind: 'unit'; readonly clip: ActionGroup['unit']; readonly group: ActionGroup['unit'] }
  /** Nothing was pasted. */
  | { readonly kind: 'tooManyFrames'; readonly count: number; readonly limit: number }
  /** Pasted as it is; the servo must not go there. */
  | ({ readonly kind: 'position' } & ServoTarget & Range);

export interface Pasted {
  readonly group: ActionGroup;
  readonly problems: readonly PasteProblem[];
}

/** How far a servo may be turned; null where unknown. */
type RangeOf = (servo: number) => Range | null;

interface PasteOptions extends Ripple {
  /** Without it no position is a problem. */
  readonly rangeOf?: RangeOf;
}

/** What is said of a frame stays with it. */
export function copyKeys(group: ActionGroup, refs: readonly KeyRef[]): Clip {
  const { keys } = lifted(group, refs);
  const firstMs = keys[0]?.atMs ?? 0;
  const moments = keys.map(({ atMs, frame: { easing }, targets }) => ({
    ...{ atMs: atMs - firstMs, easing, targets },
    ...{ note: '', colour: null },
  }));
  return { unit: group.unit, leadMs: keys[0]?.frame.durationMs ?? 0, moments };
}

/** Whole frames, one behind the other, with what is said of them. */
export function copyFrames(group: ActionGroup, ids: readonly number[]): Clip {
  const wanted = new Set(ids);
  const frames = group.frames.filter(({ id }) => wanted.has(id));
  const leadMs = frames[0]?.durationMs ?? 0;
  let atMs = -leadMs;
  const moments = frames.map(({ durationMs, easing, note, colour, targets }) => ({
    atMs: (atMs += durationMs),
    ...{ easing, note, colour, targets },
  }));
  return { unit: group.unit, leadMs, moments };
}

/**
 * The clip's first keys stand at `atMs` then. A key that meets another of its servo takes its place; with `ripple` everything
 * behind `atMs` makes room first. An empty group takes the clip's unit.
 */
export function pasteKeys(
  group: ActionGroup,
  clip: Clip,
  atMs: number,
  { ripple, rangeOf = () => null }: PasteOptions,
): Pasted {
  const problem = otherUnit(group, clip);
  if (problem !== null) return { group, problems: [problem] };
  const at = wholeMs(atMs);
  const room = ripple ? insertTime(group, at, clip.moments.at(-1)?.atMs ?? 0) : group;
  const moments = clip.moments.reduce<readonly Moment[]>(
    (all, { atMs: afterMs, targets, ...look }) =>
      placed(all, at + afterMs, targets, (own) => newMoment(at, own, look)),
    momentsOf(room),
  );
  const { markers, blocks } = room;
  const marks = { markers, ...(blocks && { blocks }) };
  const pasted = withMoments(group, moments, clip.moments.length === 0 ? {} : { unit: clip.unit, ...marks });
  return judged(group, pasted, clip, rangeOf);
}

/** The clip's frames stand from `index` on then, and everything behind comes later. An empty group takes the clip's unit. */
export function pasteFrames(
  group: ActionGroup,
  clip: Clip,
  index: number,
  { rangeOf = () => null }: Pick<PasteOptions, 'rangeOf'> = {},
): Pasted {
  const problem = otherUnit(group, clip);
  if (problem !== null) return { group, problems: [problem] };
  const { unit, frames } = clipGroup(clip);
  const pasted = frames.length === 0 ? group : insertFrames(changed(group, { unit }), index, frames);
  return judged(group, pasted, clip, rangeOf);
}

/** A group of nothing else. */
export const clipGroup = (clip: Clip): ActionGroup =>
  pasteKeys(emptyGroup('', clip.unit), clip, clip.leadMs, { ripple: false }).group;

function otherUnit(group: ActionGroup, clip: Clip): PasteProblem | null {
  const { unit } = group;
  return clip.unit === unit || !holdsMotion(group) ? null : { kind: 'unit', clip: clip.unit, group: unit };
}

function judged(group: ActionGroup, pasted: ActionGroup, clip: Clip, rangeOf: RangeOf): Pasted {
  const count = pasted.frames.length;
  return count > MAX_FRAMES
    ? { group, problems: [{ kind: 'tooManyFrames', count, limit: MAX_FRAMES }] }
    : { group: pasted, problems: outside(clip, rangeOf) };
}

/** The same keys once more, so much later or, with a negative time, sooner. */
export function duplicateKeys(
  group: ActionGroup,
  refs: readonly KeyRef[],
  deltaMs: number,
  ripple: Ripple,
): Pasted {
  const firstMs = lifted(group, refs).keys[0]?.atMs ?? 0;
  return pasteKeys(group, copyKeys(group, refs), firstMs + deltaMs, ripple);
}

function outside({ moments }: Clip, rangeOf: RangeOf): readonly PasteProblem[] {
  return moments
    .flatMap(({ targets }) => targets)
    .flatMap(({ servo, position }) => {
      const range = rangeOf(servo);
      const isWithin = range === null || (position >= range.min && position <= range.max);
      return isWithin ? [] : [{ kind: 'position', servo, position, min: range.min, max: range.max }];
    });
}
