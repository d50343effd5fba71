// The estimate as a value: what can be known of a board's motion, what it is without a command (unknown, taken over, forgotten), and what a
// way of playing groups has to answer. Knows no rule of any board: those are tracks.ts, deadlines.ts and polled.ts.

import timings from '../../protocol/timings.json' with { type: 'json' };
import type { Command, ServoTarget, Frame } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import type { ReportKind } from '../codec/reports.ts';
import {
  boardDurationMs,
  doubted,
  endMs,
  lastEndMs,
  LONGEST_MOVE_MS,
  type Order,
  type Track,
  type Tracks,
} from './tracks.ts';

// Where servos at rest stand by the board's own reports, as long as nothing can have moved them since. It is no track:
// that position was no target, and a hold goes by the tracks.

export interface Reading {
  /** null: the board has not said it since. */
  readonly position: number | null;
  /** It has no torque: hands may have turned it since, and its next move starts from anywhere. */
  readonly isReleased: boolean;
}

export type Readings = ReadonlyMap<number, Reading>;

const RELEASED: Reading = { position: null, isReleased: true };

export function afterPositions(readings: Readings, positions: readonly ServoTarget[]): Readings {
  const next = new Map(readings);
  for (const { servo, position } of positions)
    next.set(servo, { position, isReleased: readings.get(servo)?.isReleased ?? false });
  return next;
}

/** After the command left the wire; `isHeard` false where the board may not have taken it up. */
export function afterOrder(readings: Readings, command: Command, isHeard: boolean): Readings {
  if (command.kind === 'release')
    return new Map([...readings, ...command.servos.map((servo) => [servo, RELEASED] as const)]);
  if (command.kind === 'run') return onlyReleased(readings);
  if (command.kind !== 'move') return readings;
  const next = new Map(readings);
  for (const { servo } of command.targets) {
    if (next.get(servo)?.isReleased === true && !isHeard) next.set(servo, RELEASED);
    else next.delete(servo);
  }
  return next;
}

/** What the board said before is no longer so. */
export function onlyReleased(readings: Readings): Readings {
  return new Map([...readings].flatMap(([servo, { isReleased }]) => (isReleased ? [[servo, RELEASED]] : [])));
}

/** A group that may move anything at any time: its frames are not ours, or its time cannot be computed. */
interface UnknownRun {
  readonly kind: 'unknown';
  readonly slot: number | null;
  /** How many ends the board will report until nothing runs any more (S49). */
  readonly endsToHear: number;
}

/** `next` is the frame that begins at `nextAtMs`; `total` what the board takes for the group's length (S46). */
export interface DeadlineRun {
  readonly kind: 'deadlines';
  readonly slot: number;
  /** What the board heard before is taken up already. */
  readonly requestedAtMs: number;
  readonly total: number;
  readonly next: number;
  readonly nextAtMs: number;
  readonly passAtMs: number;
  /** 0: until stopped. */
  readonly times: number;
  readonly loopsDone: number;
  readonly endsToHear: number;
}

/** Known until `restAtMs`; behind it `rest` is where the servos of the later frames end, somewhen before `endMs`. */
export interface PolledRun {
  readonly kind: 'polled';
  readonly rest: ReadonlyMap<number, number>;
  readonly restAtMs: number;
  readonly surelyUntilMs: number;
  readonly endMs: number;
  /** What moved before the first frame has arrived by then; no frame takes longer than `longestMs`. */
  readonly restedMs: number;
  readonly longestMs: number;
  /** Servos of `rest` that may end elsewhere. */
  readonly unsure: ReadonlySet<number>;
  /** `rest` stands in the tracks already. */
  readonly isBlurred: boolean;
}

/**
 * The way that was asked of a servo, linear from `from` at `startMs` to `to` at `endMs`. The board has been told until `sentUntilMs`, which is
 * its place `sentTo`; the rest leaves in later parts (parts.ts).
 */
export interface Course {
  /** Null where it is unknown. */
  readonly from: number | null;
  readonly to: number;
  readonly startMs: number;
  readonly endMs: number;
  readonly sentUntilMs: number;
  readonly sentTo: number;
}

export type Courses = ReadonlyMap<number, Course>;

export interface Motion {
  readonly tracks: Tracks;
  /** Of servos that our orders move, or moved last. */
  readonly courses: Courses;
  /** Of servos at rest, with a track or without. */
  readonly readings: Readings;
  readonly run: UnknownRun | DeadlineRun | PolledRun | null;
  /** A group of known frames ran until then. */
  readonly ranUntilMs: number;
  /** Moves and frames of almost now. */
  readonly recent: readonly Order[];
  /** When a group ended by our clock whose end the board has not said yet; -Infinity for none. */
  readonly unreportedEndMs: number;
  /** Until then the board may be busy with flash or servos, its servos frozen, packets waiting or dropped (S9, S41). */
  readonly deafUntilMs: number;
  /** When it has answered all that, it hears again sooner. */
  readonly answersOwed: readonly ReportKind[];
  /** A packet came while it was deaf, and may wait to be taken up. */
  readonly mayHoldPacket: boolean;
  /** So many packets that come next it may take for the rest of one that was cut (S2, L3). */
  readonly maySwallow: number;
  /** Until then a servo we know nothing of may still be on its way. */
  readonly restlessUntilMs: number;
  /** Until then what others set in motion before the link was opened may go on. Only STOP speaks of it. */
  readonly inheritedUntilMs: number;
  /** The next run skips its first frame (L11). */
  readonly skipsFirst: 'no' | 'maybe' | 'yes';
}

/** The board as far as it stays the same while it moves. */
export interface KnownBoard {
  readonly family: Family;
  /** The group with the times it is played with (X3); empty where nothing is stored, null where unknown. */
  playedFrames(slot: number): readonly Frame[] | null;
}

export interface RunRequest {
  readonly slot: number;
  readonly times: number;
}

/** One way of playing groups. Each function gets a motion that is advanced to the time it happens. */
export interface Playback {
  request(motion: Motion, request: RunRequest, atMs: number, board: KnownBoard): Motion;
  /** Everything that was due by `nowMs` has happened. */
  advance(motion: Motion, nowMs: number, board: KnownBoard): Motion;
  stop(motion: Motion, atMs: number, board: KnownBoard): Motion;
  /** Any other command came. */
  interrupt(motion: Motion, atMs: number): Motion;
  /** The board says that a group has ended. */
  ended(motion: Motion, board: KnownBoard): Motion;
  /** How long one pass of a group takes at most. */
  passMs(frames: readonly Frame[]): number;
}

/** From the end of a group's last frame until its servos stand. */
export const LAST_TICKS_MS = timings.estimate.lastTicksMs;

/** Nothing is known: after connecting, and after anything unseen that may have moved the robot. */
export const UNKNOWN_MOTION: Motion = {
  tracks: new Map(),
  courses: new Map(),
  readings: new Map(),
  run: null,
  ranUntilMs: -Infinity,
  recent: [],
  unreportedEndMs: -Infinity,
  deafUntilMs: -Infinity,
  answersOwed: [],
  mayHoldPacket: false,
  maySwallow: 0,
  restlessUntilMs: -Infinity,
  inheritedUntilMs: -Infinity,
  skipsFirst: 'no',
};

/** It is unknown where anything is while that group may run, and behind it; perhaps its slot is empty, and the moves go on. */
export function runningUnknown(motion: Motion, slot: number | null, endsToHear = 1): Motion {
  const readings = onlyReleased(motion.readings);
  return { ...motion, tracks: doubted(motion.tracks), readings, run: { kind: 'unknown', slot, endsToHear } };
}

/** Begun so long ago (below 0: not yet); `from` is null where its start is unknown. */
export interface WayBefore {
  readonly servo: number;
  readonly from: number | null;
  readonly to: number;
  readonly begunMsAgo: number;
  readonly durationMs: number;
  /** Where it goes on to in later parts of its move, in `goalWithinMs`; null where it is the end. */
  readonly goal: number | null;
  readonly goalWithinMs: number;
}

/** Where a servo goes on to in later parts of its move. */
export interface Goal {
  readonly servo: number;
  readonly position: number;
  readonly withinMs: number;
}

/** As who sends the parts says behind one of them: its servos go on to there. */
export function headedFor(motion: Motion, goals: readonly Goal[], nowMs: number): Motion {
  const courses = new Map(motion.courses);
  for (const { servo, position, withinMs } of goals) {
    const track = motion.tracks.get(servo);
    if (track === undefined) continue;
    const sent = { sentUntilMs: endMs(track), sentTo: track.to };
    courses.set(servo, { from: null, to: position, startMs: nowMs, endMs: nowMs + withinMs, ...sent });
  }
  return { ...motion, courses };
}

/** Where the board said that a servo stood; `isCurrent`: as far as is known it stands there still. */
export interface PositionBefore {
  readonly servo: number;
  readonly position: number;
  readonly atMs: number;
  readonly isCurrent: boolean;
}

/** `runSlot`: the group that may run, whose frames are unknown. `released`: without torque, hands may have turned them. */
export interface MotionBefore {
  readonly ways: readonly WayBefore[];
  readonly runSlot: number | null;
  readonly released: readonly number[];
  readonly reported: readonly PositionBefore[];
}

/**
 * An estimate taken over from the gateway, which has seen the packets that moved the robot. A servo that is not named has an unknown
 * position.
 */
export function takenOver(motion: Motion, before: MotionBefore, nowMs: number, family: Family): Motion {
  const released = afterOrder(motion.readings, { kind: 'release', servos: before.released }, true);
  const readings = afterPositions(
    released,
    before.reported.filter(({ isCurrent }) => isCurrent),
  );
  if (before.runSlot !== null) return runningUnknown({ ...motion, readings }, before.runSlot);
  const tracks = before.ways.map((way) => [way.servo, trackOf(way, nowMs, family)] as const);
  const goals = before.ways.flatMap(({ servo, goal, goalWithinMs }) =>
    goal === null ? [] : [{ servo, position: goal, withinMs: goalWithinMs }],
  );
  return headedFor({ ...motion, readings, tracks: new Map(tracks), run: null }, goals, nowMs);
}

function trackOf({ from, to, begunMsAgo, durationMs }: WayBefore, nowMs: number, family: Family): Track {
  const startMs = nowMs - begunMsAgo;
  return {
    ...{ from, to, startMs, durationMs: boardDurationMs(durationMs, family) },
    ...{ fromLeeway: 0, toLeeway: 0 },
  };
}

/** Nothing is known any more: the robot may have been moved or the board restarted. A group that ran may run on. */
export function forgotten(motion: Motion, atMs: number): Motion {
  const { deafUntilMs, readings, run, tracks, maySwallow, restlessUntilMs, inheritedUntilMs } = motion;
  return {
    ...UNKNOWN_MOTION,
    readings: onlyReleased(readings),
    run: run && { kind: 'unknown', slot: null, endsToHear: 1 },
    deafUntilMs,
    maySwallow,
    inheritedUntilMs,
    restlessUntilMs: Math.max(
      restlessUntilMs,
      run === null ? lastEndMs(tracks, atMs) + LAST_TICKS_MS : atMs + LONGEST_MOVE_MS,
    ),
    skipsFirst: 'maybe',
  };
}

/** The former owner of the link, before it was opened at `atMs`, may have set something in motion. */
export function inherited(motion: Motion, atMs: number): Motion {
  // A question of ours may have ended their group (L8).
  return { ...motion, inheritedUntilMs: atMs + LONGEST_MOVE_MS, skipsFirst: 'maybe' };
}

/** Of two forgotten motions it is unknown which it was. */
export function eitherOf(one: Motion, other: Motion): Motion {
  return {
    ...one,
    run: one.run ?? other.run,
    deafUntilMs: Math.max(one.deafUntilMs, other.deafUntilMs),
    restlessUntilMs: Math.max(one.restlessUntilMs, other.restlessUntilMs),
    inheritedUntilMs: Math.max(one.inheritedUntilMs, other.inheritedUntilMs),
  };
}
