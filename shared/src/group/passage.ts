// The part of a group that is to be played, as frames to send one after the other: cut at both ends, faster or slower. Takes frames
// as a board does, each a straight way of all servos it names. Knows no board and no clock.

import type { Frame, ServoTarget } from '../codec/commands.ts';
import { frameEnds } from './tracks.ts';

export interface PassageOptions {
  readonly fromMs: number;
  /** null: to the end. */
  readonly toMs: number | null;
  readonly speedPercent: number;
  /** A slower frame is sent in parts. */
  readonly longestMs: number;
  /** Behind the lead, frames are sent in parts of so long at most; absent: as long as they are. */
  readonly longestPartMs?: number | undefined;
  /**
   * Servos whose position is unknown: they go to their first position in the lead, because a first move is slow and would hold up
   * the others later.
   */
  readonly unknownServos: readonly number[];
  /** How much further than written servos may go where a part that is repeated begins again at once. */
  readonly seam: {
    /** A larger step from its end to its beginning is a gentle way back. */
    readonly largestStep: number;
    /** The soft limit. */
    readonly unitsPerMs: number;
  };
}

export interface Passage {
  /** The first one leads to where the passage begins. Empty where there is nothing to play. */
  readonly frames: readonly Frame[];
  /** Repeated, it continues with this one behind its last: 0 leads back. */
  readonly loopFrom: 0 | 1;
  /** The way back is gentle: the robot ends elsewhere than it begins. */
  readonly returns: boolean;
  /** Where in the group one is when each of them is done. */
  readonly atMs: readonly number[];
  /** Where one is when the first of them begins, when it is repeated. */
  readonly beginMs: number;
}

/** The way to where a part of a group begins; one from the group's beginning has a first frame that says how long. */
const LEAD_MS = 1500;

interface Step {
  readonly beginMs: number;
  readonly endMs: number;
  readonly targets: readonly ServoTarget[];
  /** The known positions of servos before it. */
  readonly before: ReadonlyMap<number, number>;
}

export function passageOf(frames: readonly Frame[], options: PassageOptions): Passage {
  const steps = stepsOf(frames);
  const lengthMs = steps.at(-1)?.endMs ?? 0;
  const toMs = Math.min(options.toMs ?? lengthMs, lengthMs);
  const fromMs = options.fromMs < toMs ? Math.max(0, options.fromMs) : 0;
  const first = steps.findIndex(({ endMs }) => endMs > fromMs);
  const step = steps[Math.max(0, first)];
  if (step === undefined) return { frames: [], loopFrom: 0, returns: false, atMs: [], beginMs: 0 };
  const pace = 100 / options.speedPercent;
  // Before the first frame is done it is unknown where its servos come from.
  const isWhole = first <= 0;
  const startMs = isWhole ? Math.min(step.endMs, toMs) : fromMs;
  const rest = cut(isWhole ? steps.slice(1) : steps.slice(first), startMs, toMs);
  const pose = isWhole ? new Map(step.targets.map(pair)) : poseIn(step, fromMs);
  const longestPartMs = Math.min(options.longestMs, options.longestPartMs ?? Infinity);
  const parts = rest.flatMap((one) => slowed(one, startMs, pace, longestPartMs));
  const lead = {
    durationMs: isWhole ? leadMs(step, pace, options) : LEAD_MS,
    targets: targetsOf(withUnknownServos(pose, rest, options.unknownServos)),
  };
  const [begin, ...others] = parts.map(({ frame }) => frame);
  const seam = isWhole || begin === undefined ? null : seamless(begin, pose, rest.at(-1), options);
  return {
    frames: [lead, ...(begin === undefined ? [] : [seam ?? begin, ...others])],
    loopFrom: seam === null ? 0 : 1,
    returns: !isWhole && seam === null,
    atMs: [startMs, ...parts.map(({ endMs }) => endMs)],
    beginMs: isWhole ? 0 : startMs,
  };
}

const pair = ({ servo, position }: ServoTarget): [number, number] => [servo, position];

const leadMs = ({ endMs }: Step, pace: number, { longestMs }: PassageOptions): number =>
  Math.min(longestMs, Math.round(endMs * pace));

function stepsOf(frames: readonly Frame[]): readonly Step[] {
  const ends = frameEnds(frames);
  let before: ReadonlyMap<number, number> = new Map();
  return frames.map(({ targets, durationMs }, index) => {
    const endMs = ends[index] ?? 0;
    const step = { beginMs: endMs - durationMs, endMs, targets, before };
    before = new Map([...before, ...targets.map(pair)]);
    return step;
  });
}

/** Where the servos are at an instant of the step. */
function poseIn({ beginMs, endMs, targets, before }: Step, atMs: number): ReadonlyMap<number, number> {
  const share = endMs === beginMs ? 1 : (atMs - beginMs) / (endMs - beginMs);
  const pose = new Map(before);
  for (const { servo, position } of targets) {
    const from = before.get(servo);
    if (from !== undefined) pose.set(servo, Math.round(from + (position - from) * share));
    else if (share === 1) pose.set(servo, position);
  }
  return pose;
}

function cut(steps: readonly Step[], fromMs: number, toMs: number): readonly Step[] {
  return steps
    .filter(({ beginMs, endMs }) => endMs > fromMs && beginMs < toMs)
    .map((step) => part(step, Math.max(step.beginMs, fromMs), Math.min(step.endMs, toMs)));
}

function part(step: Step, beginMs: number, endMs: number): Step {
  if (beginMs === step.beginMs && endMs === step.endMs) return step;
  const pose = poseIn(step, endMs);
  const targets = step.targets.flatMap(({ servo }) => {
    const position = pose.get(servo);
    return position === undefined ? [] : [{ servo, position }];
  });
  return { beginMs, endMs, targets, before: poseIn(step, beginMs) };
}

interface Part {
  readonly frame: Frame;
  readonly endMs: number;
}

/** Times are counted from the beginning before they are rounded: nothing drifts. */
function slowed(step: Step, startMs: number, pace: number, longestMs: number): readonly Part[] {
  // Rounding may make a part longer by one.
  const count = Math.max(1, Math.ceil(((step.endMs - step.beginMs) * pace) / (longestMs - 1)));
  const edge = (index: number): number => step.beginMs + ((step.endMs - step.beginMs) * index) / count;
  const scaled = (atMs: number): number => Math.round((atMs - startMs) * pace);
  return Array.from({ length: count }, (_, index) => {
    const endMs = index === count - 1 ? step.endMs : edge(index + 1);
    const { targets } = count === 1 ? step : part(step, edge(index), endMs);
    return { frame: { durationMs: scaled(endMs) - scaled(edge(index)), targets }, endMs };
  });
}

/** The frame behind the lead so that it can follow the last one, too; null where the way to it would be too far or too fast. */
function seamless(
  begin: Frame,
  pose: ReadonlyMap<number, number>,
  last: Step | undefined,
  { seam }: PassageOptions,
): Frame | null {
  const end = last === undefined ? pose : poseIn(last, last.endMs);
  const targets = new Map([...pose, ...begin.targets.map(pair)]);
  const named = new Set(begin.targets.map(({ servo }) => servo));
  for (const [servo, position] of pose) {
    const from = end.get(servo) ?? position;
    const step = Math.abs(position - from);
    if (step > seam.largestStep || step / seam.unitsPerMs > begin.durationMs) return null;
    if (from === position && !named.has(servo)) targets.delete(servo);
  }
  return { ...begin, targets: targetsOf(targets) };
}

function withUnknownServos(
  pose: ReadonlyMap<number, number>,
  rest: readonly Step[],
  unknownServos: readonly number[],
): ReadonlyMap<number, number> {
  const firsts = new Map(
    rest
      .flatMap(({ targets }) => targets)
      .filter(({ servo }) => unknownServos.includes(servo))
      .toReversed()
      .map(pair),
  );
  return new Map([...firsts, ...pose]);
}

const targetsOf = (pose: ReadonlyMap<number, number>): readonly ServoTarget[] =>
  [...pose].map(([servo, position]) => ({ servo, position })).sort((one, other) => one.servo - other.servo);
