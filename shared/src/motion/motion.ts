// Where each servo is now, given the commands that left the wire and when. One pure value and functions over it: no clock, no link, no
// session. How a family moves is data (`Family.motion`), how it plays groups is deadlines.ts or polled.ts.
//
// Null means unknown: before the end of a servo's first move unless the board reported where it stands, while a group runs
// whose frames are not ours, behind the first frame of LeArm's groups (their times jitter, L7), after a release, in a move that flash work
// froze (S29, S41), and after a command that came when the board may have been deaf. What no packet reports is unknown too: a reset of
// the board, a pad or key pressed on a board that does not report runs, a packet lost on the way. LSC, bus boards and xArm are closed:
// their model is the simulated board's, a careful guess.

import timings from '../../protocol/timings.json' with { type: 'json' };
import type { Command, Frame, MoveCommand, ServoTarget } from '../codec/commands.ts';
import type { ReportKind } from '../codec/reports.ts';
import type { Family } from '../codec/families.ts';
import { HEADER } from '../codec/packet.ts';
import { deadlines } from './deadlines.ts';
import {
  afterOrder,
  type Courses,
  LAST_TICKS_MS,
  onlyReleased,
  type Reading,
  type Readings,
  runningUnknown,
  type KnownBoard,
  type Motion,
  type Playback,
} from './model.ts';
import { carriesAll, reTimed } from './parts.ts';
import { polled } from './polled.ts';
import {
  boardDurationMs,
  contested,
  endMs,
  lastEndMs,
  leewayOf,
  lengthened,
  LONGEST_MOVE_MS,
  only,
  ordered,
  positionOf,
  retarget,
  shareDone,
  standingAt,
  stands,
  startingAt,
  stoppedBefore,
  torn,
  type Tracks,
  unrestBehind,
} from './tracks.ts';

const PLAYBACKS: Readonly<Record<Family['motion']['groups'], Playback>> = { deadlines, polled };

/** These keep a board that answers them from its servos and packets until then: flash work, slow talk (S41, X7, L13). */
const DEAFENING: ReadonlySet<Command['kind']> = new Set([
  'download',
  'erase',
  'readPositions',
  'readAllPositions',
  'readVersion',
  'readOffsets',
]);
const ANSWERS: Readonly<Partial<Record<Command['kind'], ReportKind>>> = {
  download: 'frameStored',
  erase: 'erased',
  readPositions: 'positions',
  readAllPositions: 'allPositions',
  readVersion: 'version',
  readOffsets: 'offsets',
  readBattery: 'battery',
  run: 'runAccepted',
};
export const LONGEST_DEAFNESS_MS = timings.estimate.longestDeafnessMs;
/** What LEN does not count, and the whole of a packet without parameters. */
const HEAD_BYTES = 2;
const SHORTEST_PACKET_BYTES = 4;

function answersTo(kind: Command['kind']): readonly ReportKind[] {
  const answer = ANSWERS[kind];
  return answer === undefined ? [] : [answer];
}

export function playbackOf({ family }: KnownBoard): Playback {
  return PLAYBACKS[family.motion.groups];
}

/** The same motion with everything that was due by `nowMs` done. Call before reading it. */
export function advance(motion: Motion, nowMs: number, board: KnownBoard): Motion {
  const isKnown = motion.run !== null && motion.run.kind !== 'unknown';
  const ran = isKnown ? { ...motion, ranUntilMs: nowMs } : motion;
  return withPlannedCourses(playbackOf(board).advance(ran, nowMs, board));
}

/** What is left of a move is not sent while a group may move its servo, nor where its place is lost. */
function withPlannedCourses(motion: Motion): Motion {
  const isPlanned = (servo: number): boolean => {
    const track = motion.tracks.get(servo);
    return motion.run === null && track !== undefined && track.toLeeway < Infinity;
  };
  const planned = new Map([...motion.courses].filter(([servo]) => isPlanned(servo)));
  return planned.size === motion.courses.size ? motion : { ...motion, courses: planned };
}

/** False where the board may be too busy to take up what it is sent, or takes it for the rest of a cut packet. */
export const hears = ({ deafUntilMs, maySwallow }: Motion, atMs: number): boolean =>
  atMs >= deafUntilMs && maySwallow === 0;

/** After the last bit of `command` left the wire at `atMs`. */
export function afterCommand(motion: Motion, command: Command, atMs: number, board: KnownBoard): Motion {
  const current = advance(motion, atMs, board);
  const isHeard = hears(current, atMs);
  const after = isHeard
    ? restless(current, afterHeard(current, command, atMs, board), atMs)
    : maybeSwallowed(afterUnheard(current, command, atMs, board), atMs);
  return {
    ...after,
    courses: coursesAfter(after.courses, command, atMs, board.family),
    readings: afterOrder(after.readings, command, isHeard),
  };
}

/**
 * What is left of a move ends with a stop, a run, a release, and with a newer move of its servo. Where a move re-times servos that it does not
 * name (S26), the rest of theirs comes as much later.
 */
function coursesAfter(courses: Courses, command: Command, atMs: number, family: Family): Courses {
  if (courses.size === 0) return courses;
  if (command.kind === 'stop' || command.kind === 'run' || command.kind === 'release') return new Map();
  if (command.kind !== 'move') return courses;
  const sent = new Map(command.targets.map(({ servo, position }) => [servo, position]));
  const untilMs = carriesAll(family) ? atMs + boardDurationMs(command.durationMs, family) : -Infinity;
  const left = [...courses].filter(([servo, { sentTo }]) => (sent.get(servo) ?? sentTo) === sentTo);
  return new Map(
    left.map(([servo, course]) => [servo, sent.has(servo) ? course : reTimed(course, untilMs)] as const),
  );
}

/** What it completes then may move any servo to anywhere. */
function maybeSwallowed(motion: Motion, atMs: number): Motion {
  if (motion.maySwallow === 0) return motion;
  return {
    ...motion,
    tracks: new Map(),
    readings: onlyReleased(motion.readings),
    maySwallow: motion.maySwallow - 1,
    restlessUntilMs: Math.max(atMs, motion.deafUntilMs) + LONGEST_MOVE_MS,
  };
}

/** After one of our packets was cut. Where no filler ends it (S7) the board waits for its rest, and takes what comes next for that. */
export function afterCutPacket(motion: Motion, { resyncFiller, maxLength, leftOverBytes }: Family): Motion {
  if (resyncFiller !== null) return motion;
  // A header that it takes for LEN is more than it has room for: only an answer says that it survived that (L3).
  if (leftOverBytes < HEADER) return { ...motion, maySwallow: Infinity };
  // Cut in its head, it gets the first header of the next one for its LEN.
  const longestBytes = Math.max(HEADER, maxLength) + HEAD_BYTES;
  return { ...motion, maySwallow: Math.ceil(longestBytes / SHORTEST_PACKET_BYTES) };
}

/** The filler, whose last bit left at `atMs`, may have completed that move (S2): it begins only now. */
export function afterFiller(motion: Motion, cut: MoveCommand, atMs: number, family: Family): Motion {
  const endsMs = atMs + boardDurationMs(cut.durationMs, family) + LAST_TICKS_MS;
  return { ...motion, restlessUntilMs: Math.max(motion.restlessUntilMs, endsMs) };
}

/** Where an unknown group has ended, its last move may go on for that long. */
export function restless(before: Motion, after: Motion, atMs: number, forMs = LONGEST_MOVE_MS): Motion {
  if (before.run?.kind !== 'unknown' || after.run !== null) return after;
  return { ...after, restlessUntilMs: Math.max(after.restlessUntilMs, atMs + forMs) };
}

function afterHeard(motion: Motion, command: Command, atMs: number, board: KnownBoard): Motion {
  const playback = playbackOf(board);
  if (command.kind === 'run') return playback.request(motion, command, atMs, board);
  if (command.kind === 'stop') return playback.stop(motion, atMs, board);
  const cut = playback.interrupt(motion, atMs);
  if (command.kind === 'move') return moved(cut, command, atMs, board);
  if (command.kind === 'release') return released(cut, command.servos);
  const isAnswered = board.family.answers.includes(command.kind);
  return isAnswered && DEAFENING.has(command.kind) ? deafened(cut, command.kind, atMs) : cut;
}

function moved(
  motion: Motion,
  { targets, durationMs }: { readonly targets: readonly ServoTarget[]; readonly durationMs: number },
  atMs: number,
  { family }: KnownBoard,
): Motion {
  const order = { by: 'move', targets, atMs, before: motion.tracks } as const;
  const recent = ordered(motion.recent, order, durationMs, family);
  // A frame of that group may overrule it at any time.
  const isSure = motion.run?.kind !== 'unknown';
  const tracks = retarget(withStart(motion, targets), targets, durationMs, atMs, family, isSure);
  return {
    ...motion,
    recent,
    tracks: contested(tracks, recent, family),
    ...unrestBehind(motion, durationMs, atMs, family),
  };
}

/** Those of the targets that stand where the board said begin there. */
function withStart({ tracks, readings }: Motion, targets: readonly ServoTarget[]): Tracks {
  const standing = targets.flatMap(({ servo }) => {
    const at = heldAt(readings, servo);
    return at === null ? [] : [[servo, standingAt(at)] as const];
  });
  return new Map([...tracks, ...standing]);
}

/** Where the board said that it stands; null where it has not, or where hands may have turned it since. */
function heldAt(readings: Readings, servo: number): number | null {
  const reading = readings.get(servo);
  return reading === undefined || reading.isReleased ? null : reading.position;
}

/** It drops, who knows where to. */
function released(motion: Motion, servos: readonly number[]): Motion {
  return withoutServos(motion, servos);
}

/** Servos at rest stay; those under way freeze and jump (S29), but they arrive. A group continues at an unknown time. */
function deafened(motion: Motion, kind: Command['kind'], atMs: number): Motion {
  const deafUntilMs = atMs + LONGEST_DEAFNESS_MS;
  const deaf = { ...motion, deafUntilMs, answersOwed: answersTo(kind), mayHoldPacket: false };
  if (motion.run !== null) return runningUnknown(deaf, null);
  return { ...deaf, tracks: heldUp(motion.tracks, atMs, deafUntilMs) };
}

/** Those under way arrive, from an unknown position at an unknown time: by then at the latest. */
function heldUp(tracks: Tracks, atMs: number, untilMs: number): Tracks {
  return new Map(
    [...tracks].map(([servo, track]) => [servo, stands(track, atMs) ? track : lengthened(track, untilMs)]),
  );
}

/** It is dropped or comes late, when the board hears again. */
function afterUnheard(motion: Motion, command: Command, atMs: number, { family }: KnownBoard): Motion {
  const owed = family.answers.includes(command.kind) ? answersTo(command.kind) : [];
  const deafUntilMs = owed.length > 0 ? atMs + LONGEST_DEAFNESS_MS : motion.deafUntilMs;
  const answersOwed = [...motion.answersOwed, ...owed];
  const later = { ...motion, deafUntilMs, answersOwed, mayHoldPacket: true };
  // Nothing else can run, so its end will be the end of that group.
  if (command.kind === 'run') return runningUnknown(later, motion.run === null ? command.slot : null);
  if (command.kind === 'move') return perhapsMoved(later, command, atMs, family);
  if (command.kind === 'stop') return perhapsStopped(later, atMs, family);
  const held = heldUp(later.tracks, atMs, deafUntilMs);
  return {
    ...later,
    tracks: command.kind === 'release' ? perhapsReleased(held, command.servos, atMs) : held,
  };
}

/** It may not have moved them, and where the board re-times every servo all that was under way may be later by it (S26). */
function perhapsMoved(
  motion: Motion,
  { targets, durationMs }: { readonly targets: readonly ServoTarget[]; readonly durationMs: number },
  atMs: number,
  family: Family,
): Motion {
  const { tickMs, talkMs, timing } = family.motion;
  const untilMs = motion.deafUntilMs + boardDurationMs(durationMs, family) + tickMs + talkMs;
  const isShared = timing !== 'perServo';
  const tracks = new Map(heldUp(motion.tracks, atMs, isShared ? untilMs : motion.deafUntilMs));
  for (const { servo, position } of targets) {
    const track = motion.tracks.get(servo);
    const isThere =
      track !== undefined && stands(track, atMs) && track.to === position && track.toLeeway === 0;
    if (!isThere) tracks.set(servo, torn(track ?? startingAt(position, atMs), untilMs));
  }
  const unrest = (restlessMs: number): number =>
    isShared && restlessMs > atMs ? Math.max(restlessMs, untilMs) : restlessMs;
  return {
    ...motion,
    tracks,
    restlessUntilMs: unrest(motion.restlessUntilMs),
    inheritedUntilMs: unrest(motion.inheritedUntilMs),
  };
}

/** What a stop halts (L9) may go on, and a frame that it keeps from beginning may have begun. */
function perhapsStopped(motion: Motion, atMs: number, family: Family): Motion {
  const tracks = new Map(stoppedBefore(motion.tracks, motion.recent, atMs, family));
  for (const servo of family.motion.haltedByStop) {
    const track = tracks.get(servo);
    if (track && !stands(track, atMs)) tracks.set(servo, torn(track, motion.deafUntilMs));
  }
  return { ...motion, tracks };
}

/** Those under way drop or arrive. */
function perhapsReleased(tracks: Tracks, servos: readonly number[], atMs: number): Tracks {
  const left = only(tracks, (track, servo) => !(servos.includes(servo) && stands(track, atMs)));
  return new Map(
    [...left].map(([servo, track]) => [servo, servos.includes(servo) ? torn(track, endMs(track)) : track]),
  );
}

/** How long one pass of a group takes at most. */
export function passMs(frames: readonly Frame[], board: KnownBoard): number {
  return playbackOf(board).passMs(frames);
}

/** Present position of a servo in board units, or null while it is unknown. */
export function positionAt(motion: Motion, servo: number, nowMs: number): number | null {
  const track = motion.tracks.get(servo);
  const position = heldAt(motion.readings, servo) ?? (track ? positionOf(track, nowMs) : null);
  return position === null ? null : Math.round(position);
}

/** What the board said of a servo that nothing of ours has moved since, or null. */
export function readingOf({ readings }: Motion, servo: number): Reading | null {
  return readings.get(servo) ?? null;
}

/** How far off `positionAt` may be, in board units: the way of one tick, and more for a servo redirected on its way. */
export function leewayAt(motion: Motion, servo: number, nowMs: number, family: Family): number {
  if (heldAt(motion.readings, servo) !== null) return 0;
  const track = motion.tracks.get(servo);
  return track ? leewayOf(track, nowMs, family) : Infinity;
}

/** How far from `to` a servo may be, in board units: on a way whose start is unknown, what may be left of that way more. */
export function farthestFrom(
  motion: Motion,
  servo: number,
  to: number,
  nowMs: number,
  { position: { min, max } }: Family,
): number {
  const at = positionAt(motion, servo, nowMs);
  if (at !== null) return Math.abs(to - at);
  const track = motion.tracks.get(servo);
  if (track === undefined || track.toLeeway === Infinity) return Math.max(to - min, max - to);
  return Math.abs(to - track.to) + (max - min) * (1 - shareDone(track, nowMs));
}

/** The last commanded position of a servo, or null. */
export function targetOf(motion: Motion, servo: number): number | null {
  const track = motion.tracks.get(servo);
  if (track === undefined || track.toLeeway === Infinity) return null;
  const course = motion.courses.get(servo);
  // Its part has left.
  return course !== undefined && course.sentTo === track.to ? course.to : track.to;
}

/** The motion of the others alone. */
export function withoutServos(motion: Motion, servos: readonly number[]): Motion {
  const others = (courses: Courses): Courses =>
    new Map([...courses].filter(([servo]) => !servos.includes(servo)));
  return {
    ...motion,
    tracks: only(motion.tracks, (_, servo) => !servos.includes(servo)),
    courses: others(motion.courses),
  };
}

/** Milliseconds until the moves in progress end, with what is still to be sent of them; 0 at rest. */
export function remainingMs({ tracks, courses }: Motion, nowMs: number): number {
  return Math.max(lastEndMs(tracks, nowMs), ...[...courses.values()].map((course) => course.endMs)) - nowMs;
}

/** Milliseconds until the other servos have ended whose place is unknown on the way. */
export function unknownRestMs(motion: Motion, but: readonly number[], nowMs: number): number {
  const unknown = only(
    motion.tracks,
    (track, servo) => !but.includes(servo) && positionOf(track, nowMs) === null,
  );
  return lastEndMs(unknown, nowMs) - nowMs;
}

/** How long a move must take at least, so that no servo whose start is unknown snaps to its target. */
export function gentleMs(
  motion: Motion,
  servos: readonly number[],
  nowMs: number,
  { motion: { timing } }: Family,
): number {
  const isShared = timing !== 'perServo';
  if (isShared && motion.run?.kind === 'unknown') return Infinity;
  const unknown = only(
    motion.tracks,
    (track, servo) => positionOf(track, nowMs) === null && (isShared || servos.includes(servo)),
  );
  const restlessMs = isShared ? motion.restlessUntilMs - nowMs : 0;
  return Math.ceil(Math.max(lastEndMs(unknown, nowMs) - nowMs, restlessMs));
}
