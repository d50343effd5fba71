// The chosen keys take longer or shorter together, from their first instant or from their last; every other key stays where it is. Where
// all keys of the range are chosen its markers and pauses go along, as in any edit of time. Pure.

import type { ActionGroup } from './group.ts';
import { hasOthers, lifted } from './lifted.ts';
import { merged } from './merged.ts';
import { wholeMs, withMoments, type Moment } from './moments.ts';
import { shiftMarkersBehind, stretch, stretchBack, type Ripple, type TimeRange } from './timeEdits.ts';
import type { KeyRef } from './tracks.ts';

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
  const { kept, keys, vacated } = lifted(group, refs);
  if (!hasOthers(kept, wanted))
    return fixed === 'last' ? stretchBack(group, wanted, factor) : stretch(group, wanted, factor, { ripple });
  const growthMs = ripple && fixed === 'first' ? Math.round((toMs - fromMs) * (factor - 1)) : 0;
  const staying = kept
    .filter(({ frame }) => !vacated.has(frame.id))
    .map((moment) => (moment.atMs > toMs ? { ...moment, atMs: moment.atMs + growthMs } : moment));
  const stretched = keys.map((each) => ({ ...each, atMs: stretchedMs(each.atMs, { ...wanted, factor }) }));
  const all = merged(staying, stretched, vacated);
  // One that meets another of its servo stands on the side it came from.
  const moments = fixed === 'first' ? [...all.added, ...all.staying] : [...all.staying, ...all.added];
  return withMoments(group, moments, {
    markers: shiftMarkersBehind(group.markers, toMs, growthMs),
  });
}

/** As much of it as there is room for. */
export function boundedFactor(
  group: ActionGroup,
  refs: readonly KeyRef[],
  { fromMs, toMs, factor, fixed, ripple }: KeyStretch,
): number {
  const { kept } = lifted(group, refs);
  const servos = new Set(refs.map(({ servo }) => servo));
  const isAll = !hasOthers(kept, { fromMs, toMs });
  const stopsThem = ({ frame }: Moment): boolean =>
    isAll || frame.targets.some(({ servo }) => servos.has(servo));
  const lengthMs = toMs - fromMs;
  const by = Math.max(0, factor);
  if (fixed === 'last') {
    const before = kept.findLast((moment) => moment.atMs < fromMs && stopsThem(moment));
    return Math.min(by, (toMs - (before?.atMs ?? 0)) / lengthMs);
  }
  if (!ripple) {
    const next = kept.find((moment) => moment.atMs > toMs && stopsThem(moment));
    return Math.min(by, ((next?.atMs ?? Infinity) - fromMs) / lengthMs);
  }
  const behind = kept.find(({ atMs }) => atMs > toMs);
  const last = kept.findLast(({ atMs, frame }) => atMs > fromMs && atMs <= toMs && frame.targets.length > 0);
  return behind === undefined || last === undefined
    ? by
    : Math.max(by, 1 + (last.atMs - behind.atMs) / lengthMs);
}
