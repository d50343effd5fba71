// What a compiled group costs on a board, and what of it the board cannot do: each with servo, frame and number, so that a
// person can mend it. Knows limits; makes no frame.

import type { Frame } from '../codec/commands.ts';
import { positionRange, type Family, type Range } from '../codec/families.ts';
import { wireMs } from '../codec/packet.ts';
import { DEGREES_PER_UNIT } from '../profile/readyRobots.ts';
import { servoOf, type Robot } from '../profile/robot.ts';
import { type Course, type Leg, ROUNDING, type Deviation } from './courses.ts';
import { blocksOf } from './blocks.ts';
import { curveOf, turnsOf, type Easing } from './curves.ts';
import { totalDurationMs, type ActionGroup } from './group.ts';

/** Common servos of these robots need 0.2 s for 60 degrees, some a little less. */
const SERVO_DEGREES_PER_S = 300;

export interface CompileOptions {
  readonly family: Family;
  /** In the group's unit; positions are whole, so that less than 0.5 is seldom reached. */
  readonly maxErrorUnits: number;
  /** Its limits, trims and degrees. */
  readonly robot?: Robot;
  /** Where servos stand when the group begins, as far as that is known. */
  readonly start?: ReadonlyMap<number, number>;
  /** How fast the servos can turn. */
  readonly degreesPerS?: number;
}

export type CompileProblem =
  | { readonly kind: 'unit'; readonly group: ActionGroup['unit']; readonly board: ActionGroup['unit'] }
  | ({ readonly kind: 'servo'; readonly servo: number } & Range)
  /** A `frameId` below zero is of a block, as in blocks.ts. */
  | ({ readonly kind: 'position'; readonly servo: number; readonly frameId: number } & Range & {
        readonly position: number;
      })
  /** On its way to its key: the curve goes past an end of the servo's range. */
  | ({ readonly kind: 'swing'; readonly servo: number; readonly frameId: number } & Range & {
        readonly position: number;
      })
  /** In a frame of the compiled group. */
  | { readonly kind: 'tooManyServos'; readonly frame: number; readonly count: number; readonly limit: number }
  | { readonly kind: 'tooManyFrames'; readonly count: number; readonly limit: number }
  /** The key is passed over: the board cannot be there in less than this time. */
  | { readonly kind: 'tooShort'; readonly servo: number; readonly frameId: number; readonly leastMs: number }
  /** Its fastest way, that ends then. */
  | {
      readonly kind: 'tooFast';
      readonly servo: number;
      readonly atMs: number;
      readonly degreesPerS: number;
      readonly limit: number;
    }
  | ({ readonly kind: 'deviation'; readonly limit: number } & Deviation);

export interface CompileReport {
  readonly frameCount: number;
  readonly frameLimit: number;
  readonly durationMs: number;
  /** Of all download packets. */
  readonly bytes: number;
  /** About; null where the board takes no download. */
  readonly downloadMs: number | null;
  /** Null where the frames are the group. */
  readonly worst: (Deviation & { readonly degrees: number }) | null;
  /** How far keys are off their times, because the board counts ticks. */
  readonly shiftedMs: number;
  readonly problems: readonly CompileProblem[];
}

interface CompiledParts {
  readonly group: ActionGroup;
  readonly options: CompileOptions;
  readonly courses: readonly Course[];
  readonly frames: readonly Frame[];
  readonly worst: Deviation | null;
}

export function reportOf(parts: CompiledParts): CompileReport {
  const { options, courses, frames, worst } = parts;
  const { family } = options;
  const bytes = frames.reduce((sum, { targets }) => sum + packetBytes(targets.length), 0);
  const degrees = worst === null ? 0 : worst.units * degreesPerUnit(worst.servo, options);
  return {
    ...{ frameCount: frames.length, frameLimit: family.framesPerGroup, bytes },
    durationMs: totalDurationMs(frames),
    downloadMs: family.commands.includes('download') ? downloadMs(bytes, frames.length) : null,
    worst: worst && { ...worst, degrees },
    shiftedMs: courses.reduce((most, { shiftedMs }) => Math.max(most, shiftedMs), 0),
    problems: problemsOf(parts),
  };
}

/** How far a servo may be turned, as a person counts: what the robot allows of what the board takes. */
export function rangeOf(servo: number, family: Family, robot?: Robot): Range {
  const board = positionRange(family, servo);
  const own = robot && servoOf(robot, servo);
  if (own === undefined) return board;
  return { min: Math.max(own.min, board.min - own.trim), max: Math.min(own.max, board.max - own.trim) };
}

function degreesPerUnit(servo: number, { robot, family }: CompileOptions): number {
  return (robot && servoOf(robot, servo))?.degreesPerUnit ?? DEGREES_PER_UNIT[family.unit];
}

/** Header, LEN, CMD, slot, frame count and number, servo count, time; then three bytes a servo. */
const packetBytes = (servoCount: number): number => 10 + 3 * servoCount;

/** Typical: erasing the slot before the first frame, the count table behind the last (boards.md section 3, flash times). */
const EDGES_MS = 180 + 46;
/** The answer, the flash page and the pause before the next packet. */
const FRAME_MS = wireMs(4) + 1 + 10;

const downloadMs = (bytes: number, frameCount: number): number =>
  frameCount === 0 ? 0 : wireMs(bytes) + EDGES_MS + frameCount * FRAME_MS;

function problemsOf(parts: CompiledParts): readonly CompileProblem[] {
  const { group, options, frames, worst } = parts;
  const { family, maxErrorUnits: limit } = options;
  const { framesPerGroup, unit } = family;
  const problems: CompileProblem[] = [];
  if (group.unit !== unit) problems.push({ kind: 'unit', group: group.unit, board: unit });
  problems.push(...keyProblems(group, options), ...courseProblems(parts));
  if (frames.length > framesPerGroup)
    problems.push({ kind: 'tooManyFrames', count: frames.length, limit: framesPerGroup });
  for (const [frame, { targets }] of frames.entries())
    if (targets.length > family.servosPerFrame)
      problems.push({ kind: 'tooManyServos', frame, count: targets.length, limit: family.servosPerFrame });
  if (worst !== null && worst.units > limit + ROUNDING) problems.push({ kind: 'deviation', limit, ...worst });
  return problems;
}

function keyProblems(group: ActionGroup, { family, robot }: CompileOptions): CompileProblem[] {
  const blocks = blocksOf(group).flatMap(({ id, moments }) =>
    moments.map(({ targets }) => ({ id: -id, targets })),
  );
  return [...group.frames, ...blocks].flatMap(({ id: frameId, targets }) =>
    targets.flatMap(({ servo, position }): CompileProblem[] => {
      if (servo < family.servo.min || servo > family.servo.max) return [];
      const range = rangeOf(servo, family, robot);
      const isWithin = position >= range.min && position <= range.max;
      return isWithin ? [] : [{ kind: 'position', servo, frameId, position, ...range }];
    }),
  );
}

function courseProblems({ courses, options }: CompiledParts): CompileProblem[] {
  const { family, degreesPerS: limit = SERVO_DEGREES_PER_S } = options;
  return courses.flatMap(({ servo, legs, missed }) => {
    const problems: CompileProblem[] = missed.map(({ frameId }) => ({
      ...{ kind: 'tooShort', servo, frameId, leastMs: family.shortestMoveMs },
    }));
    if (servo < family.servo.min || servo > family.servo.max)
      problems.push({ kind: 'servo', servo, ...family.servo });
    else problems.push(...swings(servo, legs, rangeOf(servo, family, options.robot)));
    const fastest = fastestOf(legs);
    const degreesPerS = fastest === null ? 0 : speedOf(fastest) * degreesPerUnit(servo, options) * 1000;
    if (fastest !== null && degreesPerS > limit)
      problems.push({
        kind: 'tooFast',
        servo,
        atMs: fastest.toMs,
        degreesPerS: Math.round(degreesPerS),
        limit,
      });
    return problems;
  });
}

/** A key beyond the range is a problem of its own. */
function swings(servo: number, legs: readonly Leg[], range: Range): CompileProblem[] {
  return legs.flatMap((leg) => {
    const { min, max } = range;
    const [low, high] = [Math.min(min, leg.from, leg.to), Math.max(max, leg.from, leg.to)];
    return turnsOf(leg.easing)
      .map((share) => Math.round(leg.from + share * (leg.to - leg.from)))
      .filter((position) => position < low || position > high)
      .slice(0, 1)
      .map((position) => ({ kind: 'swing', servo, frameId: leg.frameId, position, min, max }));
  });
}

/** Jumps are to be as fast as can be. */
function fastestOf(legs: readonly Leg[]): Leg | null {
  return legs
    .filter(({ isJump }) => !isJump)
    .reduce<Leg | null>((most, leg) => (most === null || speedOf(leg) > speedOf(most) ? leg : most), null);
}

/** In units a millisecond. */
function speedOf({ fromMs, toMs, from, to, easing }: Leg): number {
  return (Math.abs(to - from) / (toMs - fromMs)) * steepest(easing);
}

/** A slope that would be endless is that of the mean over so much of the time. */
const SLOPE_STEPS = 64;

/** The greatest slope. */
function steepest(easing: Easing): number {
  if (typeof easing === 'string') return easing === 'linear' ? 1 : 2;
  const { at } = curveOf(easing);
  const slopes = Array.from({ length: SLOPE_STEPS }, (_, step) =>
    Math.abs(at((step + 1) / SLOPE_STEPS) - at(step / SLOPE_STEPS)),
  );
  return SLOPE_STEPS * Math.max(...slopes);
}
