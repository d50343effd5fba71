// Edits of single keys, as pure functions: (group, arguments) → group, the very same object where nothing changes. Servos that
// are not named continue exactly as before. What shifts time for all servos is timeEdits.ts.

import { handlesOf, handleTime, handleWay, sameEasing, type Easing } from './curves.ts';
import { easingOf, type ActionGroup, type GroupFrame, type KeyTarget } from './group.ts';
import { changed, sameList, samePose } from './groupEdits.ts';
import { momentsOf, newMoment, placed, wholeMs, withMoments, withOwnEasing, type Moment } from './moments.ts';
import { lifted, servosByFrame } from './keyRanges.ts';
import { closeFrames, setDuration, type Ripple } from './timeEdits.ts';
import { tracksOf, type Key, type KeyRef } from './tracks.ts';

/** What the document can write down; what a board takes is far less. */
const LARGEST_POSITION = 0xffff;

const wholePosition = (position: number): number =>
  Math.min(LARGEST_POSITION, Math.max(0, Math.round(position)));

/**
 * The servo is at `position` at `atMs`. Where no frame ends there, one begins and ends there now, and comes in as the one it
 * was cut from; a key that is there comes in as before.
 */
export function setKey(group: ActionGroup, servo: number, atMs: number, position: number): ActionGroup {
  const moments = momentsOf(group);
  const at = wholeMs(atMs);
  const there = moments.findLast((moment) => moment.atMs === at);
  const { easing = 'linear' } = (there ?? moments.find((moment) => moment.atMs > at))?.frame ?? {};
  const before = there?.frame.targets.find((target) => target.servo === servo);
  const targets = [{ ...before, servo, position: wholePosition(position) }];
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
    const there = targets.map((target) => atPosition(target, target.position + deltaPosition));
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
  return changeFrames(group, (frame) => {
    const servos = chosen.get(frame.id);
    if (servos === undefined) return frame;
    const targets = frame.targets.map((target) => {
      const { servo, position } = target;
      return servos.has(servo) ? atPosition(target, wholePosition(change(position, servo, frame))) : target;
    });
    return samePose(frame.targets, targets) ? frame : { ...frame, targets };
  });
}

/** Written out: spread takes several times as long, and there may be thousands. */
function atPosition({ servo, easing }: KeyTarget, position: number): KeyTarget {
  return easing === undefined ? { servo, position } : { servo, position, easing };
}

function changeFrames(group: ActionGroup, change: (frame: GroupFrame) => GroupFrame): ActionGroup {
  return changed(group, { frames: sameList(group.frames, group.frames.map(change)) });
}

// How servos come into their keys.

export function setEasing(group: ActionGroup, refs: readonly KeyRef[], easing: Easing): ActionGroup {
  const chosen = servosByFrame(refs);
  return changeEasings(group, chosen, ({ servo, frameId, easing: before }) =>
    chosen.get(frameId)?.has(servo) === true ? easing : before,
  );
}

/** Where all keys of a frame are come to alike, its frame says so; else it says what it said. */
function changeEasings(
  group: ActionGroup,
  frames: { has(frameId: number): boolean },
  change: (key: KeyRef & Pick<Key, 'easing'>) => Easing,
): ActionGroup {
  return changeFrames(group, (frame) => {
    if (!frames.has(frame.id)) return frame;
    const easings = frame.targets.map((target) =>
      change({ servo: target.servo, frameId: frame.id, easing: easingOf(target, frame) }),
    );
    const [first = frame.easing] = easings;
    const isOne = easings.every((one) => sameEasing(one, first)) && !sameEasing(first, frame.easing);
    const easing = isOne ? first : frame.easing;
    const targets = frame.targets.map((target, index) =>
      withOwnEasing(target, easings[index] ?? easing, easing),
    );
    return changed(frame, { easing, targets: sameList(frame.targets, targets) });
  });
}

/**
 * The servo passes these keys without a change of speed, and never swings past one: it stops where the motion turns round, at the first
 * and at the last key (after Fritsch and Carlson, 1980). The other end of each way stays as it is.
 */
export function smoothKeys(group: ActionGroup, refs: readonly KeyRef[]): ActionGroup {
  const chosen = servosByFrame(refs);
  const isChosen = ({ frameId, servo }: KeyRef): boolean => chosen.get(frameId)?.has(servo) === true;
  const curves = new Map<string, Easing>();
  const frames = new Set<number>();
  for (const { keys } of tracksOf(group).values()) {
    const speeds = keys.map((key, index) => (isChosen(key) ? speedThrough(keys, index) : null));
    for (const [index, to] of keys.entries()) {
      const from = keys[index - 1];
      const [begin, end] = [speeds[index - 1] ?? null, speeds[index] ?? null];
      if (from === undefined || (begin === null && end === null)) continue;
      frames.add(to.frameId);
      curves.set(nameOf(to.frameId, to.servo), smoothWay(from, to, begin, end));
    }
  }
  return changeEasings(
    group,
    frames,
    ({ frameId, servo, easing }) => curves.get(nameOf(frameId, servo)) ?? easing,
  );
}

/** In units a millisecond: between the speeds of the ways before and behind it, no more than three times the slower one. */
function speedThrough(keys: readonly Key[], index: number): number {
  const [before, key, next] = [keys[index - 1], keys[index], keys[index + 1]];
  if (before === undefined || key === undefined || next === undefined) return 0;
  const [beforeMs, nextMs] = [key.atMs - before.atMs, next.atMs - key.atMs];
  if (beforeMs === 0 || nextMs === 0) return 0;
  const [one, other] = [(key.position - before.position) / beforeMs, (next.position - key.position) / nextMs];
  if (one * other <= 0) return 0;
  const [weight, otherWeight] = [2 * nextMs + beforeMs, nextMs + 2 * beforeMs];
  return (weight + otherWeight) / (weight / one + otherWeight / other);
}

const THIRD = 1 / 3;

/** null: as it was at that end. */
function smoothWay(from: Key, to: Key, begin: number | null, end: number | null): Easing {
  const [lengthMs, way] = [to.atMs - from.atMs, to.position - from.position];
  const before = handlesOf(to.easing) ?? [THIRD, THIRD, 1 - THIRD, 1 - THIRD];
  if (lengthMs === 0 || way === 0) return to.easing;
  const rise = (speed: number): number => handleWay((speed * THIRD * lengthMs) / way);
  return [
    ...(begin === null ? ([before[0], before[1]] as const) : ([handleTime(THIRD), rise(begin)] as const)),
    ...(end === null
      ? ([before[2], before[3]] as const)
      : ([handleTime(1 - THIRD), handleWay(1 - rise(end))] as const)),
  ];
}
