// The chosen keys in the opposite order, or slower or faster together; every other key stays where it is. Where all keys of that
// time are chosen its markers and pauses go along, as in any edit of time. Pure.

import { sortedTargets } from '../codec/commands.ts';
import type { ActionGroup, GroupFrame, KeyTarget } from './group.ts';
import { carried, momentsOf, withTargets, type Moment, newMoment, withMoments, wholeMs } from './moments.ts';
import {
  type TimeRange,
  backwards,
  reverse,
  shiftBehind,
  stretch,
  stretchBack,
  type Ripple,
} from './timeEdits.ts';
import type { KeyRef } from './tracks.ts';

// Keys that an edit means, taken out of their frames.

interface LiftedKeys {
  readonly atMs: number;
  readonly frame: GroupFrame;
  readonly targets: readonly KeyTarget[];
}

interface Lifted {
  /** Every moment, without these keys. */
  readonly remaining: readonly Moment[];
  readonly keys: readonly LiftedKeys[];
  /** The frames that had no other key and carry no note or colour: nothing is left to keep them for. */
  readonly vacated: ReadonlySet<number>;
}

/** The named keys, frame by frame, and what is left without them. */
export function lifted(group: ActionGroup, refs: readonly KeyRef[]): Lifted {
  const chosen = servosByFrame(refs);
  const keys: LiftedKeys[] = [];
  const vacated = new Set<number>();
  const remaining = momentsOf(group).map((moment) => {
    const { atMs, frame } = moment;
    const servos = chosen.get(frame.id);
    if (servos === undefined) return moment;
    const targets = frame.targets.filter(({ servo }) => servos.has(servo));
    if (targets.length === 0) return moment;
    keys.push({ atMs, frame, targets });
    const left = frame.targets.filter(({ servo }) => !servos.has(servo));
    if (left.length === 0 && frame.note === '' && frame.colour === null) vacated.add(frame.id);
    return withTargets(moment, left);
  });
  return { remaining, keys, vacated };
}

/** Whether keys are left in the range, its ends included. */
function hasOthers(remaining: Lifted['remaining'], { fromMs, toMs }: TimeRange): boolean {
  return remaining.some(({ atMs, frame }) => atMs >= fromMs && atMs <= toMs && frame.targets.length > 0);
}

export function servosByFrame(refs: readonly KeyRef[]): ReadonlyMap<number, ReadonlySet<number>> {
  const servos = new Map<number, Set<number>>();
  for (const { frameId, servo } of refs) {
    const own = servos.get(frameId);
    if (own === undefined) servos.set(frameId, new Set([servo]));
    else own.add(servo);
  }
  return servos;
}

// Lifted keys put down at new instants among the moments that stay.

interface Merged {
  /** The moments that stay, with the keys that came to them. */
  readonly staying: readonly Moment[];
  /** Those of the keys that came to no moment, or met another key of their servo there. */
  readonly added: readonly Moment[];
}

/** A frame that loses all its keys goes along with them. No key is lost: one that meets another of its servo stands at the same instant. */
function merged(before: readonly Moment[], keys: Lifted['keys'], vacated: Lifted['vacated']): Merged {
  const moments = [...before];
  const placeAt = new Map(before.map(({ atMs }, index) => [atMs, index]));
  for (const { atMs, frame, targets } of keys) {
    const place = placeAt.get(atMs) ?? -1;
    const there = moments[place];
    if (there === undefined || isInOne(there.frame.targets, targets)) {
      placeAt.set(atMs, moments.length);
      moments.push(movedFrame(frame, targets, atMs, vacated.has(frame.id)));
    } else {
      const arriving = carried(targets, frame.easing, there.frame.easing);
      const all = sortedTargets([...there.frame.targets, ...arriving]);
      moments[place] = { ...there, frame: { ...there.frame, targets: all } };
    }
  }
  return { staying: moments.slice(0, before.length), added: moments.slice(before.length) };
}

function isInOne(some: readonly KeyTarget[], others: readonly KeyTarget[]): boolean {
  const servos = new Set(some.map(({ servo }) => servo));
  return others.some(({ servo }) => servos.has(servo));
}

const movedFrame = (
  frame: GroupFrame,
  targets: readonly KeyTarget[],
  atMs: number,
  isVacated: boolean,
): Moment =>
  isVacated ? { atMs, frame: { ...frame, targets } } : newMoment(atMs, targets, { easing: frame.easing });

// The chosen keys come in the opposite order, each in its servo's row, from their first instant to their last; every
// other key stays where it is. Where all keys of that time are chosen its markers and pauses go along, as in any edit
// of time.

/** `refs` name keys of the group, each once. Each way between two of them is gone as before, the other way round. */
export function reverseKeys(group: ActionGroup, refs: readonly KeyRef[]): ActionGroup {
  const ends = keyedEnds(group);
  // Thousands of keys, mostly all of them: nothing has to be lifted.
  if (refs.length === ends.keys) return ends.keys === 0 ? group : reverse(group, ends);
  const { remaining, keys, vacated } = lifted(group, refs);
  const [first, last] = [keys[0], keys.at(-1)];
  if (first === undefined || last === undefined) return group;
  const range = { fromMs: first.atMs, toMs: last.atMs };
  if (!hasOthers(remaining, range)) return reverse(group, range);
  if (range.fromMs === range.toMs) return group;
  const frames = backwards(keys.map(({ frame, targets }) => ({ ...frame, targets })));
  const reversed = keys.toReversed().flatMap(({ atMs }, index) => {
    const frame = frames[index];
    return frame === undefined
      ? []
      : { atMs: range.fromMs + range.toMs - atMs, frame, targets: frame.targets };
  });
  const staying = remaining.filter(({ frame }) => !vacated.has(frame.id));
  const all = merged(staying, reversed, vacated);
  return withMoments(group, [...all.staying, ...all.added]);
}

/** How many keys there are, and the instants of the first and the last. */
function keyedEnds(group: ActionGroup): TimeRange & { readonly keys: number } {
  const keyed = momentsOf(group).filter(({ frame }) => frame.targets.length > 0);
  const [fromMs, toMs] = [keyed[0]?.atMs ?? 0, keyed.at(-1)?.atMs ?? 0];
  return { fromMs, toMs, keys: keyed.reduce((sum, { frame }) => sum + frame.targets.length, 0) };
}

// The chosen keys take longer or shorter together, from their first instant or from their last; every other key stays
// where it is. Where all keys of the range are chosen its markers and pauses go along, as in any edit of time.

export interface KeyStretch extends TimeRange, Ripple {
  readonly factor: number;
  /** The end that stays. With the last one nothing behind it goes along. */
  readonly fixed: 'first' | 'last';
}

/** When an instant of the range is then; `factor` as `boundedFactor` has it. */
export function stretchedMs(
  atMs: number,
  { fromMs, toMs, factor, fixed }: Omit<KeyStretch, 'ripple'>,
): number {
  return wholeMs(fixed === 'last' ? toMs - (toMs - atMs) * factor : fromMs + (atMs - fromMs) * factor);
}

/**
 * They grow no farther than to the next key of their servos that is not chosen. With `ripple` all that is behind goes along, and comes
 * no nearer than the last key that stays.
 */
export function stretchKeys(group: ActionGroup, refs: readonly KeyRef[], wanted: KeyStretch): ActionGroup {
  const { fromMs, toMs, fixed, ripple } = wanted;
  if (toMs <= fromMs || refs.length === 0) return group;
  const factor = boundedFactor(group, refs, wanted);
  const { remaining, keys, vacated } = lifted(group, refs);
  if (!hasOthers(remaining, wanted))
    return fixed === 'last' ? stretchBack(group, wanted, factor) : stretch(group, wanted, factor, { ripple });
  const growthMs = ripple && fixed === 'first' ? Math.round((toMs - fromMs) * (factor - 1)) : 0;
  const staying = remaining
    .filter(({ frame }) => !vacated.has(frame.id))
    .map((moment) => (moment.atMs > toMs ? { ...moment, atMs: moment.atMs + growthMs } : moment));
  const stretched = keys.map((each) => ({ ...each, atMs: stretchedMs(each.atMs, { ...wanted, factor }) }));
  const all = merged(staying, stretched, vacated);
  // One that meets another of its servo stands on the side it came from.
  const moments = fixed === 'first' ? [...all.added, ...all.staying] : [...all.staying, ...all.added];
  return withMoments(group, moments, shiftBehind(group, toMs, growthMs));
}

/** As much of it as there is room for. */
export function boundedFactor(
  group: ActionGroup,
  refs: readonly KeyRef[],
  { fromMs, toMs, factor, fixed, ripple }: KeyStretch,
): number {
  const { remaining } = lifted(group, refs);
  const servos = new Set(refs.map(({ servo }) => servo));
  const isAll = !hasOthers(remaining, { fromMs, toMs });
  const stopsThem = ({ frame }: Moment): boolean =>
    isAll || frame.targets.some(({ servo }) => servos.has(servo));
  const lengthMs = toMs - fromMs;
  const by = Math.max(0, factor);
  if (fixed === 'last') {
    const before = remaining.findLast((moment) => moment.atMs < fromMs && stopsThem(moment));
    return Math.min(by, (toMs - (before?.atMs ?? 0)) / lengthMs);
  }
  if (!ripple) {
    const next = remaining.find((moment) => moment.atMs > toMs && stopsThem(moment));
    return Math.min(by, ((next?.atMs ?? Infinity) - fromMs) / lengthMs);
  }
  const behind = remaining.find(({ atMs }) => atMs > toMs);
  const last = remaining.findLast(
    ({ atMs, frame }) => atMs > fromMs && atMs <= toMs && frame.targets.length > 0,
  );
  return behind === undefined || last === undefined
    ? by
    : Math.max(by, 1 + (last.atMs - behind.atMs) / lengthMs);
}
