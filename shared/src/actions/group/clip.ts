// Keys taken out of a group to be put into it again or into another one. A clip knows servos, positions and how far its keys
// are apart, not where it comes from. What cannot be pasted is said; nothing is changed to make it fit.

import type { ServoTarget } from '../../protocol/commands.ts';
import type { Range } from '../../protocol/families.ts';
import { MAX_FRAMES, type ActionGroup, type Easing } from './group.ts';
import { lifted } from './lifted.ts';
import { momentsOf, newMoment, placed, wholeMs, withMoments, type Moment } from './moments.ts';
import { insertTime, type Ripple } from './timeEdits.ts';
import type { KeyRef } from './tracks.ts';

export interface Clip {
  readonly unit: ActionGroup['unit'];
  /** The first one at 0. */
  readonly moments: readonly ClipMoment[];
}

interface ClipMoment {
  readonly atMs: number;
  readonly easing: Easing;
  readonly targets: readonly ServoTarget[];
}

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

export interface PasteOptions extends Ripple {
  /** How far a servo may be turned; null where nobody knows. Without it no position is a problem. */
  readonly rangeOf?: (servo: number) => Range | null;
}

export function copyKeys(group: ActionGroup, refs: readonly KeyRef[]): Clip {
  const { keys } = lifted(group, refs);
  const firstMs = keys[0]?.atMs ?? 0;
  const moments = keys.map(({ atMs, frame: { easing }, targets }) => ({
    atMs: atMs - firstMs,
    easing,
    targets,
  }));
  return { unit: group.unit, moments };
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
  const isEmpty = group.frames.length === 0;
  if (clip.unit !== group.unit && !isEmpty)
    return { group, problems: [{ kind: 'unit', clip: clip.unit, group: group.unit }] };
  const at = wholeMs(atMs);
  const room = ripple ? insertTime(group, at, clip.moments.at(-1)?.atMs ?? 0) : group;
  const moments = clip.moments.reduce<readonly Moment[]>(
    (all, { atMs: afterMs, easing, targets }) =>
      placed(all, at + afterMs, targets, (own) => newMoment(at, own, easing)),
    momentsOf(room),
  );
  const { markers } = room;
  const pasted = withMoments(group, moments, clip.moments.length === 0 ? {} : { unit: clip.unit, markers });
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

function outside({ moments }: Clip, rangeOf: (servo: number) => Range | null): readonly PasteProblem[] {
  return moments
    .flatMap(({ targets }) => targets)
    .flatMap(({ servo, position }) => {
      const range = rangeOf(servo);
      const isWithin = range === null || (position >= range.min && position <= range.max);
      return isWithin ? [] : [{ kind: 'position', servo, position, min: range.min, max: range.max }];
    });
}
