// Keys and easings become the frames a board can take: straight ways between whole poses on its ticks, as few as the error
// bound allows. Nothing is changed to make it fit; what does not fit stands in the report. Knows what a family takes; sends
// nothing.
//
// The bound: at any instant each servo is where the group has it, give or take `maxErrorUnits`, once its keys stand on the
// board's ticks and jumps last one step of them; how far keys came off their times for that is in the report.

import type { Frame, ServoTarget } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import { reportOf, type CompileOptions, type CompileReport } from './compileReport.ts';
import {
  courseAt,
  coursesOf,
  gridMs,
  onGrid,
  type Course,
  missOf,
  ROUNDING,
  type Deviation,
  type Straight,
} from './courses.ts';
import { blocksOf, motionLengthMs, motionTracks } from './blocks.ts';
import { isStraight, type ActionGroup, type GroupFrame } from './group.ts';

export interface Compiled {
  readonly frames: readonly Frame[];
  readonly report: CompileReport;
}

export function compile(group: ActionGroup, options: CompileOptions): Compiled {
  const { family, maxErrorUnits, start = new Map<number, number>() } = options;
  const stepMs = gridMs(family);
  const tracks = motionTracks(group);
  const courses = coursesOf(tracks, stepMs, start);
  const endMs = onGrid(motionLengthMs(group), stepMs);
  const isDirect = isTakenAsItIs(group, tracks.size, family);
  const { frames, worst } = isDirect
    ? { frames: group.frames.map(plain), worst: null }
    : fitted(courses, endMs, { stepMs, maxErrorUnits, longestMs: family.durationMs.max });
  const report = reportOf({
    group,
    options,
    courses: isDirect ? courses.map(exact) : courses,
    frames,
    worst,
  });
  return { frames, report };
}

const plain = ({ durationMs, targets }: GroupFrame): Frame => ({
  durationMs,
  targets: targets.map(({ servo, position }) => ({ servo, position })),
});

const exact = (course: Course): Course => ({ ...course, missed: [], shiftedMs: 0 });

/** Each frame is a whole pose, reached straight, in a time the board keeps. */
function isTakenAsItIs(group: ActionGroup, servoCount: number, family: Family): boolean {
  const { frames } = group;
  const { motion, shortestMoveMs, durationMs: allowed, framesPerGroup } = family;
  return (
    blocksOf(group).length === 0 &&
    frames.length <= framesPerGroup &&
    frames.every(
      (frame) =>
        frame.targets.length === servoCount &&
        isStraight(frame) &&
        frame.durationMs % motion.tickMs === 0 &&
        frame.durationMs >= shortestMoveMs &&
        frame.durationMs <= allowed.max,
    )
  );
}

interface Fit {
  readonly stepMs: number;
  readonly longestMs: number;
  readonly maxErrorUnits: number;
}

/** The longest frame that keeps the bound, then the longest behind it, and so on. */
function fitted(courses: readonly Course[], endMs: number, fit: Fit) {
  const ends = endsOf(courses, endMs);
  const frames: Frame[] = [];
  let worst: Deviation | null = null;
  // A servo that comes from an unknown position comes to its first key with the end of a frame.
  const arrivals = courses.flatMap(({ knownFromMs }) => (knownFromMs > 0 ? [knownFromMs] : []));
  const longestMs = fit.longestMs - (fit.longestMs % fit.stepMs);
  for (let fromMs = 0; fromMs < endMs;) {
    const limitMs = fromMs === 0 ? Math.min(longestMs, ...arrivals) : fromMs + longestMs;
    const toMs = longestFrom(fromMs, limitMs, ends, courses, fit);
    frames.push(frameOf(courses, fromMs, toMs));
    for (const course of courses) {
      const { units, atMs } = missOf(course, straight(course, fromMs, toMs));
      if (units > (worst?.units ?? 0)) worst = { servo: course.servo, atMs, units };
    }
    fromMs = toMs;
  }
  return { frames, worst };
}

/** Where servos come to a key: the best places for the end of a frame, because there they stand exactly where they were set. */
function endsOf(courses: readonly Course[], endMs: number): readonly number[] {
  const ends = new Set(courses.flatMap(({ legs }) => legs.map(({ toMs }) => toMs)));
  return [...ends.add(endMs)].sort((one, other) => one - other);
}

function longestFrom(
  fromMs: number,
  limitMs: number,
  ends: readonly number[],
  courses: readonly Course[],
  { stepMs, maxErrorUnits }: Fit,
): number {
  const enough = maxErrorUnits + ROUNDING;
  const holds = (toMs: number): boolean =>
    courses.every((course) => missOf(course, straight(course, fromMs, toMs), enough).units <= enough);
  const ahead = ends.filter((atMs) => atMs > fromMs && atMs <= limitMs);
  const failing = ahead.findIndex((atMs) => !holds(atMs));
  const reached = failing === -1 ? ahead.at(-1) : ahead[failing - 1];
  if (reached !== undefined) return reached;
  const steps = Math.floor(((ahead[0] ?? limitMs) - fromMs) / stepMs);
  return fromMs + stepMs * mostSteps(steps, (count) => holds(fromMs + count * stepMs));
}

/** One step at least: the board cannot take less. */
function mostSteps(limit: number, holds: (count: number) => boolean): number {
  if (holds(limit)) return limit;
  let least = 1;
  let most = limit;
  while (most - least > 1) {
    const middle = (least + most) >> 1;
    if (holds(middle)) least = middle;
    else most = middle;
  }
  return least;
}

const wholeAt = (course: Course, atMs: number): number => Math.round(courseAt(course, atMs));

function straight(course: Course, fromMs: number, toMs: number): Straight {
  return { fromMs, toMs, from: wholeAt(course, fromMs), to: wholeAt(course, toMs) };
}

/** The first frame names every servo, because a group may be repeated; later ones those under way. */
function frameOf(courses: readonly Course[], fromMs: number, toMs: number): Frame {
  const underWay = courses.filter(
    (course) => fromMs === 0 || wholeAt(course, fromMs) !== wholeAt(course, toMs),
  );
  // A frame without any servo is over at once on a board that waits for arrivals (L7).
  const named = underWay.length > 0 ? underWay : courses.slice(0, 1);
  const targets: ServoTarget[] = named.map((course) => ({
    servo: course.servo,
    position: wholeAt(course, toMs),
  }));
  return { durationMs: toMs - fromMs, targets };
}
