// Long moves leave in parts: each packet sends the servos under way to their places at its end, and the next one leaves before that end.
// So a packet for one servo never hastens another, a lost packet costs one part, and what is left of a move ends by not being sent.
// Pure: knows ways, times and the family; no clock, no wire. Twin: backend/servodeck/robot/motion/parts.py.

import timings from '../../protocol/timings.json' with { type: 'json' };
import type { MoveCommand, ServoTarget } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import { moveBytes, wireMs } from '../codec/packet.ts';
import type { Course, Courses, Motion } from './model.ts';
import { boardDurationMs, endMs, LONGEST_MOVE_MS, positionOf, stands, type Track } from './tracks.ts';

/** One servo of a move that was asked for. */
export interface ServoOrder extends ServoTarget {
  readonly durationMs: number;
}

export interface PartOptions {
  readonly family: Family;
  /** Servos that one packet carries. */
  readonly servosPerMove: number;
  /** No packet is shorter: a servo of unknown place is on its way. 0 where there is none. One that starts goes in one packet of its full time. */
  readonly leastMs: number;
}

/** `courses` are those behind the packet. */
export interface Part {
  readonly move: MoveCommand;
  readonly courses: Courses;
}

const REST_MS = timings.parts.restMs;
const SEAM_MS = timings.parts.seamMs;
const SLACK_MS = timings.parts.seamSlackMs;
const GRAIN_MS = timings.parts.grainMs;

/** Where one new target may change the time of every servo, each packet carries all that are under way (S26). */
export const carriesAll = ({ motion }: Family): boolean => motion.timing !== 'perServo';

/** Time until the next packet of this size can take effect: shorter moves would make the servo stop and go. */
export function intervalMs(servoCount: number, family: Family): number {
  return Math.max(family.shortestMoveMs, Math.ceil(wireMs(moveBytes(servoCount)) + family.serviceGapMs));
}

/** When the next part has to begin to leave; Infinity where none follows. */
export function partDueMs(motion: Motion, nowMs: number): number {
  const wayMs = wireMs(moveBytes(underWay(motion, nowMs).size));
  const dues = [...motion.courses].map(([servo, course]) => {
    const track = motion.tracks.get(servo);
    if (track === undefined || !isUnfinished(course)) return Infinity;
    // Until its place is known again it cannot go on.
    return positionOf(track, nowMs) === null ? endMs(track) : dueMs(course, wayMs);
  });
  return Math.min(...dues, Infinity);
}

const dueMs = ({ sentUntilMs }: Course, wayMs: number): number => sentUntilMs - SEAM_MS - wayMs;

/** The next packet: the new orders, and the servos that have to go on with it. Null where there is nothing to send now. */
export function nextPart(
  motion: Motion,
  orders: readonly ServoOrder[],
  nowMs: number,
  options: PartOptions,
): Part | null {
  const { family, servosPerMove } = options;
  const ordered = new Set(orders.map(({ servo }) => servo));
  const going = [...underWay(motion, nowMs)].filter(([servo]) => !ordered.has(servo));
  const wayMs = wireMs(moveBytes(going.length + orders.length));
  const isDue = ([, course]: readonly [number, Course]): boolean =>
    isUnfinished(course) && dueMs(course, wayMs) <= nowMs + SLACK_MS;
  if (orders.length === 0 && partDueMs(motion, nowMs) > nowMs + GRAIN_MS) return null;
  const { carried, left } = shared(going, isDue, servosPerMove - orders.length, family);
  const count = orders.length + carried.length;
  const arrivesMs = nowMs + wireMs(moveBytes(count));
  const carriedCourses = carried.map(([servo, course]) => [servo, delayed(course, arrivesMs)] as const);
  const own = orders.map((order) => [order.servo, courseFor(motion, order, arrivesMs)] as const);
  const courses = new Map([...own, ...carriedCourses]);
  const isJoined = carried.length > 0;
  // A way whose start is unknown cannot be cut, nor one whose part the board may not hear.
  const isHeard = arrivesMs >= motion.deafUntilMs && motion.maySwallow === 0;
  const whole = [...courses.values()].filter(({ from }) => from === null || !isHeard);
  const leastMs = Math.max(options.leastMs, ...whole.map((course) => course.endMs - arrivesMs));
  const durationMs = partMs([...courses.values()], left, arrivesMs, isJoined, { ...options, leastMs });
  const span = { arrivesMs, durationMs, untilMs: arrivesMs + boardDurationMs(durationMs, family) };
  const sent = [...courses].map(([servo, course]) => [servo, sentOn(course, span)] as const);
  const targets = sent.map(([servo, { sentTo }]) => ({ servo, position: sentTo }));
  const others = [...motion.courses].filter(
    ([servo, course]) => isUnfinished(course) || going.some(([other]) => other === servo),
  );
  return { move: { kind: 'move', targets, durationMs }, courses: new Map([...others, ...sent]) };
}

type Going = readonly (readonly [servo: number, course: Course])[];

/** Those that the packet carries, and those that it may re-time without naming them, because there is no room. */
function shared(
  going: Going,
  isDue: (one: Going[number]) => boolean,
  room: number,
  family: Family,
): { readonly carried: Going; readonly left: readonly Course[] } {
  if (!carriesAll(family)) return { carried: going.filter(isDue).slice(0, room), left: [] };
  if (going.length <= room) return { carried: going, left: [] };
  // Servos on their last part arrive with the packet rather than cut it short.
  const carried = going
    .filter(([, course]) => isUnfinished(course))
    .toSorted(([, one], [, other]) => one.sentUntilMs - other.sentUntilMs)
    .slice(0, room);
  return { carried, left: going.filter((one) => !carried.includes(one)).map(([, course]) => course) };
}

/** The courses of all servos under way whose place is known; one that no order of ours has moved goes on by its track. */
function underWay(motion: Motion, nowMs: number): Courses {
  const all = new Map<number, Course>();
  for (const [servo, track] of motion.tracks) {
    const at = positionOf(track, nowMs);
    if (at === null) continue;
    const course = motion.courses.get(servo) ?? courseOf(track);
    if (isUnfinished(course) || !(stands(track, nowMs) || Math.abs(track.to - at) <= 1))
      all.set(servo, course);
  }
  return all;
}

function courseOf(track: Track): Course {
  const { from, to, startMs } = track;
  const end = endMs(track);
  return { from, to, startMs, endMs: end, sentUntilMs: end, sentTo: to };
}

function courseFor(motion: Motion, { servo, position, durationMs }: ServoOrder, arrivesMs: number): Course {
  const track = motion.tracks.get(servo);
  const reading = motion.readings.get(servo);
  const stood = reading?.isReleased === false ? reading.position : null;
  const from = stood ?? (track === undefined ? null : positionOf(track, arrivesMs));
  const end = arrivesMs + durationMs;
  return {
    ...{ from, to: position, startMs: arrivesMs, endMs: end },
    ...{ sentUntilMs: arrivesMs, sentTo: position },
  };
}

/** The board has stood at the seam since: the rest comes as much later, and no faster. */
function delayed(course: Course, arrivesMs: number): Course {
  const lateMs = arrivesMs - course.sentUntilMs;
  if (lateMs <= 0 || !isUnfinished(course)) return course;
  return { ...course, startMs: course.startMs + lateMs, endMs: course.endMs + lateMs };
}

/** A packet that does not name its servo has the board done with its part only then. */
export function reTimed(course: Course, untilMs: number): Course {
  if (untilMs <= course.sentUntilMs) return course;
  return { ...delayed(course, untilMs), sentUntilMs: untilMs };
}

const isUnfinished = (course: Course): boolean => course.endMs > course.sentUntilMs;

/** The time of the packet: until the first of its servos arrives, at most one part, and not before those that it leaves out. */
function partMs(
  courses: readonly Course[],
  left: readonly Course[],
  arrivesMs: number,
  isJoined: boolean,
  { family, leastMs }: PartOptions,
): number {
  const seams = left.filter(isUnfinished).map((course) => course.sentUntilMs - arrivesMs);
  const leftMs = Math.max(0, ...left.map((course) => course.sentUntilMs - arrivesMs));
  const arrivals = courses.map(({ endMs: end, sentUntilMs }) => Math.max(end, sentUntilMs) - arrivesMs);
  // Servos past their time arrive with any packet.
  const ends = [...arrivals, ...seams].filter((ms) => ms > GRAIN_MS);
  const firstMs = Math.min(...ends, LONGEST_MOVE_MS);
  // Servos that arrive almost together arrive together.
  const togetherMs = Math.max(0, ...ends.filter((ms) => ms <= firstMs + REST_MS));
  const longestMs = family.motion.partMs ?? Infinity;
  const wantedMs =
    togetherMs <= longestMs + GRAIN_MS ? togetherMs : inTicks(Math.min(longestMs, firstMs - REST_MS), family);
  const intervalOfAllMs = intervalMs(courses.length, family);
  const durationMs = Math.ceil(Math.max(wantedMs, leastMs, leftMs, intervalOfAllMs) - GRAIN_MS);
  // Boards cut the rest of a tick, which would make the servos under way faster.
  const isUnderWayLater = courses.some((course) => course.endMs > arrivesMs + durationMs + GRAIN_MS);
  const whole =
    isUnderWayLater || isJoined ? inTicks(durationMs + family.motion.tickMs - 1, family) : durationMs;
  return Math.min(whole, family.durationMs.max);
}

const inTicks = (ms: number, { motion: { tickMs } }: Family): number => Math.floor(ms / tickMs) * tickMs;

/** Of a packet: its arrival, the time that it names, and when the board is done with it, which counts in ticks. */
interface Span {
  readonly arrivesMs: number;
  readonly durationMs: number;
  readonly untilMs: number;
}

/** The course as that packet sends it on. */
function sentOn(course: Course, { arrivesMs, durationMs, untilMs }: Span): Course {
  const { from, to, startMs } = course;
  if (from === null || course.endMs <= arrivesMs + durationMs + GRAIN_MS)
    return { ...course, sentUntilMs: Math.max(untilMs, course.endMs), sentTo: to };
  const done = Math.max(0, untilMs - startMs) / (course.endMs - startMs);
  return { ...course, sentUntilMs: untilMs, sentTo: Math.round(from + (to - from) * done) };
}
