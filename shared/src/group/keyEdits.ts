// Edits of single keys, as pure functions: (group, arguments) → group, the very same object where nothing changes. Servos that
// are not named go on exactly as they did. What shifts time for everybody is timeEdits.ts.

import type { ActionGroup, GroupFrame } from './group.ts';
import { changed, sameList, samePose } from './groupEdits.ts';
import { momentsOf, newMoment, placed, wholeMs, withMoments, type Moment } from './moments.ts';
import { lifted, servosByFrame } from './keyRanges.ts';
import { closeFrames, setDuration, type Ripple } from './timeEdits.ts';
import { tracksOf, type KeyRef } from './tracks.ts';

/** What the document can write down; what a board takes is far less. */
const LARGEST_POSITION = 0xffff;

const wholePosition = (position: number): number =>
  Math.min(LARGEST_POSITION, Math.max(0, Math.round(position)));

/**
 * The servo is at `position` at `atMs`. Where no frame ends there, one begins and ends there now, and comes in as the one it
 * was cut from.
 */
export function setKey(group: ActionGroup, servo: number, atMs: number, position: number): ActionGroup {
  const moments = momentsOf(group);
  const at = wholeMs(atMs);
  const { easing = 'linear' } = moments.find((moment) => moment.atMs >= at)?.frame ?? {};
  const targets = [{ servo, position: wholePosition(position) }];
  return withMoments(
    group,
    placed(moments, at, targets, (own) => newMoment(at, own, { easing })),
  );
}

/** A key with its new position. */
interface KeyPosition extends KeyRef {
  readonly position: number;
}

export function setPositions(group: ActionGroup, keys: readonly KeyPosition[]): ActionGroup {
  const wanted = new Map(keys.map(({ frameId, servo, position }) => [nameOf(frameId, servo), position]));
  return changePositions(
    group,
    keys,
    (position, servo, frame) => wanted.get(nameOf(frame.id, servo)) ?? position,
  );
}

const nameOf = (frameId: number, servo: number): string => `${frameId}/${servo}`;

/** Frames left without a key go, unless they carry a note or a colour; with `ripple` their time goes too. */
export function deleteKeys(group: ActionGroup, refs: readonly KeyRef[], { ripple }: Ripple): ActionGroup {
  const { remaining, vacated } = lifted(group, refs);
  const left = remaining.filter(({ frame }) => !vacated.has(frame.id));
  return ripple ? closeFrames(group, left, vacated) : withMoments(group, left);
}

export interface KeyMove {
  readonly deltaMs: number;
  readonly deltaPosition: number;
}

/** As far as all these keys can go together: not before the beginning, not beyond the numbers a document holds. */
export function boundedMove(
  keys: readonly { readonly atMs: number; readonly position: number }[],
  { deltaMs, deltaPosition }: KeyMove,
): KeyMove {
  if (keys.length === 0) return { deltaMs: 0, deltaPosition: 0 };
  let [firstMs, lowest, highest] = [Infinity, Infinity, -Infinity];
  for (const { atMs, position } of keys) {
    if (atMs < firstMs) firstMs = atMs;
    if (position < lowest) lowest = position;
    if (position > highest) highest = position;
  }
  return {
    deltaMs: Math.max(-firstMs, Math.round(deltaMs)),
    deltaPosition: Math.min(LARGEST_POSITION - highest, Math.max(-lowest, Math.round(deltaPosition))),
  };
}

/**
 * Moves keys in time and place, as far as all of them can go. One that meets another key of its servo takes its place; frames
 * left without a key go, unless they carry a note or a colour. With `ripple` time itself moves: the frame of the earliest key
 * takes that much longer or shorter, and everything behind it goes along.
 */
export function moveKeys(
  group: ActionGroup,
  refs: readonly KeyRef[],
  move: KeyMove,
  { ripple }: Ripple,
): ActionGroup {
  const { remaining, keys, vacated } = lifted(group, refs);
  const chosen = keys.flatMap(({ atMs, targets }) => targets.map(({ position }) => ({ atMs, position })));
  const { deltaMs, deltaPosition } = boundedMove(chosen, move);
  if (deltaMs === 0 || ripple) {
    const turned = changePositions(group, refs, (position) => position + deltaPosition);
    return ripple ? rippled(turned, refs, deltaMs) : turned;
  }
  // A frame that loses all its keys goes along with the first of them, so that it keeps its name.
  const staying = remaining.filter(({ frame }) => !vacated.has(frame.id));
  const moved = keys.reduce<readonly Moment[]>((moments, { atMs, frame, targets }) => {
    const there = targets.map(({ servo, position }) => ({ servo, position: position + deltaPosition }));
    return placed(moments, atMs + deltaMs, there, (own) =>
      vacated.has(frame.id)
        ? { atMs, frame: { ...frame, targets: own } }
        : newMoment(atMs, own, { easing: frame.easing }),
    );
  }, staying);
  return withMoments(group, moved);
}

function rippled(group: ActionGroup, refs: readonly KeyRef[], deltaMs: number): ActionGroup {
  const frames = new Set(refs.map(({ frameId }) => frameId));
  const first = group.frames.find(({ id }) => frames.has(id));
  return first === undefined
    ? group
    : setDuration(group, first.id, Math.max(0, first.durationMs + deltaMs), { ripple: true });
}

/**
 * The servos begin one after another: of those that move, in the order of their numbers, each one does `stepMs` later what it does. Until then
 * it stays at its first key; the group takes that much longer. The others, and those that are not `free`, stay as they are.
 */
export function stagger(group: ActionGroup, stepMs: number, isFree: (servo: number) => boolean): ActionGroup {
  const moving = [...tracksOf(group)].filter(
    ([servo, { keys }]) => isFree(servo) && keys.some(({ position }) => position !== keys[0]?.position),
  );
  return moving.reduce((before, [servo], index) => delayed(before, servo, index * stepMs), group);
}

function delayed(group: ActionGroup, servo: number, byMs: number): ActionGroup {
  const [first, second, ...others] = tracksOf(group).get(servo)?.keys ?? [];
  if (first === undefined || second === undefined || byMs === 0) return group;
  const later = moveKeys(group, [second, ...others], { deltaMs: byMs, deltaPosition: 0 }, { ripple: false });
  return second.atMs === first.atMs || second.position === first.position
    ? later
    : setKey(later, servo, first.atMs + byMs, first.position);
}

/** About where each servo's swing grows or shrinks: the mean of its keys among those, or the positions given. */
type AmplitudeCentre = 'mean' | ReadonlyMap<number, number>;

/** Servos without a centre stay as they are. */
export function scaleAmplitude(
  group: ActionGroup,
  refs: readonly KeyRef[],
  factor: number,
  about: AmplitudeCentre,
): ActionGroup {
  const centres = about === 'mean' ? meansOf(group, refs) : about;
  return changePositions(group, refs, (position, servo) => {
    const centre = centres.get(servo) ?? position;
    return centre + (position - centre) * factor;
  });
}

function meansOf(group: ActionGroup, refs: readonly KeyRef[]): ReadonlyMap<number, number> {
  const sums = new Map<number, { readonly sum: number; readonly count: number }>();
  for (const { servo, position } of lifted(group, refs).keys.flatMap(({ targets }) => targets)) {
    const { sum, count } = sums.get(servo) ?? { sum: 0, count: 0 };
    sums.set(servo, { sum: sum + position, count: count + 1 });
  }
  return new Map([...sums].map(([servo, { sum, count }]) => [servo, sum / count]));
}

function changePositions(
  group: ActionGroup,
  refs: readonly KeyRef[],
  change: (position: number, servo: number, frame: GroupFrame) => number,
): ActionGroup {
  const chosen = servosByFrame(refs);
  const frames = group.frames.map((frame) => {
    const servos = chosen.get(frame.id);
    if (servos === undefined) return frame;
    const targets = frame.targets.map((target) => {
      const { servo, position } = target;
      return servos.has(servo) ? { servo, position: wholePosition(change(position, servo, frame)) } : target;
    });
    return samePose(frame.targets, targets) ? frame : { ...frame, targets };
  });
  return changed(group, { frames: sameList(group.frames, frames) });
}
