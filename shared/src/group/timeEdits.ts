// Edits of a group's time: frames and stretches of it take longer or shorter, go or turn round. Pure functions, the very same
// object where nothing changes. Markers go along with what they stand on. Knows no key's position.

import { sameEasing, type Easing } from './curves.ts';
import {
  easingOf,
  FASTEST_PERCENT,
  SLOWEST_PERCENT,
  type ActionGroup,
  type Block,
  type GroupFrame,
  type Marker,
} from './group.ts';
import { changed, indexOfFrame, sameList } from './groupEdits.ts';
import { momentsOf, wholeMs, withMoments, withOwnEasing, type Moment } from './moments.ts';

export interface Ripple {
  /** Everything behind goes along; otherwise it stays at its time. */
  readonly ripple: boolean;
}

/** From the first to the last instant. */
export interface TimeRange {
  readonly fromMs: number;
  readonly toMs: number;
}

/** Moves a frame's end; its neighbours' are as far as it goes. */
export function moveBoundary(
  group: ActionGroup,
  frameId: number,
  deltaMs: number,
  { ripple }: Ripple,
): ActionGroup {
  const index = indexOfFrame(group, frameId);
  const frame = group.frames[index];
  if (frame === undefined) return group;
  const nextMs = ripple ? Infinity : (group.frames[index + 1]?.durationMs ?? Infinity);
  const byMs = Math.min(nextMs, Math.max(-frame.durationMs, Math.round(deltaMs)));
  const isMoved = (other: number): boolean => other === index || (ripple && other > index);
  const moments = momentsOf(group);
  const moved = moments.map((moment, other) => (isMoved(other) ? later(moment, byMs) : moment));
  const endMs = moments[index]?.atMs ?? 0;
  return withMoments(group, moved, ripple ? marksAt(group, (atMs) => shifted(atMs, endMs, byMs)) : {});
}

/** What stood within the time that is gone stands at its end. */
function shifted(atMs: number, endMs: number, byMs: number): number {
  return atMs >= endMs ? atMs + byMs : Math.min(atMs, endMs + byMs);
}

export function setDuration(
  group: ActionGroup,
  frameId: number,
  durationMs: number,
  ripple: Ripple,
): ActionGroup {
  const frame = group.frames[indexOfFrame(group, frameId)];
  return frame === undefined ? group : moveBoundary(group, frameId, durationMs - frame.durationMs, ripple);
}

/** Everything behind `atMs` comes `durationMs` later: the servos take that much longer to their next keys. */
export function insertTime(group: ActionGroup, atMs: number, durationMs: number): ActionGroup {
  return retimed(group, (time) => (time > atMs ? time + durationMs : time));
}

/** What stands behind the first instant up to the last goes, keys and markers; everything behind it comes so much sooner. */
export function deleteTime(group: ActionGroup, { fromMs, toMs }: TimeRange): ActionGroup {
  if (toMs <= fromMs) return group;
  const isOutside = ({ atMs }: { readonly atMs: number }): boolean => atMs <= fromMs || atMs > toMs;
  const closed = (atMs: number): number => (atMs > toMs ? atMs - (toMs - fromMs) : atMs);
  return retimed(group, closed, isOutside);
}

/** The moments that are left without these frames come so much sooner, and the markers. */
export function closeFrames(
  group: ActionGroup,
  left: readonly Moment[],
  gone: ReadonlySet<number>,
): ActionGroup {
  const soonerMs = timeOf(group, gone);
  const moved = left.map((moment) => later(moment, -soonerMs(moment.atMs)));
  return withMoments(
    group,
    moved,
    marksAt(group, (atMs) => atMs - soonerMs(atMs)),
  );
}

/** How much of the time before an instant these frames take. */
function timeOf({ frames }: ActionGroup, ids: ReadonlySet<number>): (atMs: number) => number {
  const spans: { readonly fromMs: number; readonly toMs: number }[] = [];
  let toMs = 0;
  for (const { id, durationMs } of frames) {
    const fromMs = toMs;
    toMs += durationMs;
    if (ids.has(id)) spans.push({ fromMs, toMs });
  }
  return (atMs) => spans.reduce((sum, span) => sum + Math.max(0, Math.min(atMs, span.toMs) - span.fromMs), 0);
}

/** The range takes `factor` times as long from its beginning. Without `ripple` it grows no farther than to what is behind it. */
export function stretch(
  group: ActionGroup,
  { fromMs, toMs }: TimeRange,
  factor: number,
  { ripple }: Ripple,
): ActionGroup {
  if (toMs <= fromMs) return group;
  const next = momentsOf(group).find(({ atMs }) => atMs > toMs);
  const roomMs = ripple ? Infinity : (next?.atMs ?? Infinity) - fromMs;
  const by = Math.min(Math.max(0, factor), roomMs / (toMs - fromMs));
  const growthMs = ripple ? (toMs - fromMs) * (by - 1) : 0;
  return retimed(group, (atMs) => {
    if (atMs <= fromMs) return atMs;
    return atMs <= toMs ? fromMs + (atMs - fromMs) * by : atMs + growthMs;
  });
}

/** The same from its end: it grows no farther than to what is before it, and nothing behind it moves. */
export function stretchBack(group: ActionGroup, { fromMs, toMs }: TimeRange, factor: number): ActionGroup {
  if (toMs <= fromMs) return group;
  const before = momentsOf(group).findLast(({ atMs }) => atMs < fromMs);
  const by = Math.min(Math.max(0, factor), (toMs - (before?.atMs ?? 0)) / (toMs - fromMs));
  return retimed(group, (atMs) => (atMs < fromMs || atMs > toMs ? atMs : toMs - (toMs - atMs) * by));
}

/** The whole group takes `factor` times as long. */
export function scaleTime(group: ActionGroup, factor: number): ActionGroup {
  const scaled = retimed(group, (atMs) => atMs * Math.max(0, factor));
  const blocks = scaled.blocks?.map((block) => changed<Block>(block, scaledBlock(block, factor)));
  return blocks === undefined ? scaled : changed(scaled, { blocks: sameList(scaled.blocks ?? [], blocks) });
}

const scaledBlock = ({ speedPercent, blendInMs, blendOutMs }: Block, factor: number): Partial<Block> => ({
  speedPercent: Math.min(
    FASTEST_PERCENT,
    Math.max(SLOWEST_PERCENT, Math.round(speedPercent / Math.max(0.01, factor))),
  ),
  blendInMs: wholeMs(blendInMs * factor),
  blendOutMs: wholeMs(blendOutMs * factor),
});

/**
 * The keys of the range come in the opposite order. Each way is gone as before, the other way round; how a servo comes into the
 * range stays.
 */
export function reverse(group: ActionGroup, { fromMs, toMs }: TimeRange): ActionGroup {
  const isWithin = (atMs: number): boolean => atMs >= fromMs && atMs <= toMs;
  const turned = (atMs: number): number => (isWithin(atMs) ? fromMs + toMs - atMs : atMs);
  const moments = momentsOf(group);
  const within = moments.filter(({ atMs }) => isWithin(atMs));
  const frames = backwards(within.map(({ frame }) => frame));
  const reversed = within
    .toReversed()
    .map(({ atMs, frame }, index) => ({ atMs: turned(atMs), frame: frames[index] ?? frame }));
  const first = moments.findIndex(({ atMs }) => isWithin(atMs));
  const all = within.length < 2 ? moments : moments.toSpliced(first, within.length, ...reversed);
  return withMoments(group, all, { markers: markersAt(group.markers, turned) });
}

/** Frames in the opposite order, each key with the easing of the way that is then gone to it; the very same where nothing is other than before. */
export function backwards(frames: readonly GroupFrame[]): readonly GroupFrame[] {
  const [first] = frames;
  if (first === undefined || frames.every((frame) => isReversible(frame, first.easing)))
    return frames.toReversed();
  const into = firstEasings(frames);
  const behind = new Map<number, Easing>();
  return frames.toReversed().map((frame, index) => {
    const next = frames[frames.length - index];
    const easing = next === undefined ? first.easing : reversedEasing(next.easing);
    const targets = frame.targets.map((target) => {
      const gone = behind.get(target.servo);
      const own = gone === undefined ? into.get(target.servo) : reversedEasing(gone);
      behind.set(target.servo, easingOf(target, frame));
      return withOwnEasing(target, own ?? easing, easing);
    });
    const sameTargets = sameList(frame.targets, targets);
    return easing === frame.easing && sameTargets === frame.targets
      ? frame
      : { ...frame, easing, targets: sameTargets };
  });
}

/** All keys come in alike, and that way is the same from both ends. */
const isReversible = ({ easing, targets }: GroupFrame, alike: Easing): boolean =>
  sameEasing(easing, alike) &&
  sameEasing(easing, reversedEasing(easing)) &&
  targets.every((target) => target.easing === undefined);

/** How each servo comes to its first key. */
function firstEasings(frames: readonly GroupFrame[]): ReadonlyMap<number, Easing> {
  const easings = new Map<number, Easing>();
  for (const frame of frames)
    for (const target of frame.targets)
      if (!easings.has(target.servo)) easings.set(target.servo, easingOf(target, frame));
  return easings;
}

/** Every moment and marker that stays, at its new time. */
function retimed(
  group: ActionGroup,
  at: (atMs: number) => number,
  stays: (one: { readonly atMs: number }) => boolean = () => true,
): ActionGroup {
  const moments = momentsOf(group).filter(stays);
  const moved = moments.map((moment) => ({ ...moment, atMs: wholeMs(at(moment.atMs)) }));
  return withMoments(group, moved, marksAt({ ...group, markers: group.markers.filter(stays) }, at));
}

const later = (moment: Moment, byMs: number): Moment => ({ ...moment, atMs: moment.atMs + byMs });

/** Markers and blocks behind an instant come so much later. */
export const shiftBehind = (group: ActionGroup, instantMs: number, byMs: number): Marks =>
  marksAt(group, (atMs) => (atMs > instantMs ? atMs + byMs : atMs));

type Marks = Partial<Pick<ActionGroup, 'markers' | 'blocks'>>;

/** A block moves as its beginning does, and lasts as long as before. */
function marksAt({ markers, blocks }: ActionGroup, at: (atMs: number) => number): Marks {
  const moved = blocks?.map((block) => changed<Block>(block, { startMs: wholeMs(at(block.startMs)) }));
  return { markers: markersAt(markers, at), ...(blocks && moved && { blocks: sameList(blocks, moved) }) };
}

function markersAt(markers: readonly Marker[], at: (atMs: number) => number): readonly Marker[] {
  return markers.map((marker) => {
    const atMs = wholeMs(at(marker.atMs));
    return atMs === marker.atMs ? marker : { ...marker, atMs };
  });
}

/** The same way seen from its end. A jump has no other end. */
export function reversedEasing(easing: Easing): Easing {
  if (typeof easing !== 'string') {
    const [x1, y1, x2, y2] = easing;
    return [mirrored(x2), mirrored(y2), mirrored(x1), mirrored(y1)];
  }
  return easing === 'in' ? 'out' : easing === 'out' ? 'in' : easing;
}

/** Twice is as before, in spite of what numbers round. */
const mirrored = (share: number): number => Math.round((1 - share) * 1e6) / 1e6;
