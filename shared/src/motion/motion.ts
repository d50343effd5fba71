// Where each servo is now, given the commands that left the wire and when. One pure value and functions over it: no clock,
// no link, no session. How a family moves is data (`Family.motion`), how it plays groups is deadlines.ts or polled.ts.
//
// Null means that nobody can know: before the end of a servo's first move unless the board told where it stands (told.ts), while a group runs whose frames are not ours,
// behind the first frame of LeArm's groups (their times jitter, L7), after a release, in a move that flash work froze (S29,
// S41), and after a command that came when the board may have been deaf. What nobody tells us we cannot know at all: a reset
// of the board, a pad or key pressed on a board that does not report runs, a packet lost on the way. LSC, bus boards and
// xArm are closed: their model is the simulated board's, a careful guess.

import type { Command, Frame, ServoTarget } from '../protocol/commands.ts';
import type { Report, ReportKind } from '../protocol/reports.ts';
import type { Family } from '../protocol/families.ts';
import { deadlines } from './deadlines.ts';
import { runningUnknown, UNKNOWN_MOTION, type KnownBoard, type Motion, type Playback } from './model.ts';
import { polled } from './polled.ts';
import { afterOrder, afterPositions, onlyLetGo } from './told.ts';
import {
  endMs,
  lastEndMs,
  leewayOf,
  LONGEST_MOVE_MS,
  only,
  positionOf,
  retarget,
  standingAt,
  stands,
  type Tracks,
} from './tracks.ts';

export { UNKNOWN_MOTION, type KnownBoard, type Motion };

const PLAYBACKS: Readonly<Record<Family['motion']['groups'], Playback>> = { deadlines, polled };

/** These keep the board from its servos and packets until it has answered: flash work, slow talk (S41, X7, L13). */
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
/** The worst of them: four sectors and the count table (S33, S34), with a margin. */
const LONGEST_DEAFNESS_MS = 2_500;

function answersTo(kind: Command['kind']): readonly ReportKind[] {
  const answer = ANSWERS[kind];
  return answer === undefined ? [] : [answer];
}

function playbackOf({ family }: KnownBoard): Playback {
  return PLAYBACKS[family.motion.groups];
}

/** The same motion with everything that was due by `nowMs` done. Call before reading it. */
export function advance(motion: Motion, nowMs: number, board: KnownBoard): Motion {
  return playbackOf(board).advance(motion, nowMs, board);
}

/** False where the board may be too busy to take up what it is told. */
export const hears = ({ deafUntilMs }: Motion, atMs: number): boolean => atMs >= deafUntilMs;

/** After the last bit of `command` left the wire at `atMs`. */
export function afterCommand(motion: Motion, command: Command, atMs: number, board: KnownBoard): Motion {
  const current = advance(motion, atMs, board);
  const isHeard = hears(current, atMs);
  const after = isHeard
    ? restless(current, afterHeard(current, command, atMs, board), atMs)
    : afterUnheard(current, command, atMs, board);
  return { ...after, told: afterOrder(after.told, command, isHeard) };
}

/** Where a group nobody knows has ended, its last move may go on. */
function restless(before: Motion, after: Motion, atMs: number): Motion {
  if (before.run?.kind !== 'unknown' || after.run !== null) return after;
  return { ...after, restlessUntilMs: atMs + LONGEST_MOVE_MS };
}

function afterHeard(motion: Motion, command: Command, atMs: number, board: KnownBoard): Motion {
  const playback = playbackOf(board);
  if (command.kind === 'run') return playback.request(motion, command, atMs, board);
  if (command.kind === 'stop') return playback.stop(motion, atMs, board);
  const cut = playback.interrupt(motion, atMs);
  if (command.kind === 'move') return moved(cut, command, atMs, board);
  if (command.kind === 'release') return released(cut, command.servos);
  return DEAFENING.has(command.kind) ? deafened(cut, command.kind, atMs) : cut;
}

function moved(
  motion: Motion,
  { targets, durationMs }: { readonly targets: readonly ServoTarget[]; readonly durationMs: number },
  atMs: number,
  { family }: KnownBoard,
): Motion {
  // A frame of that group may overrule it at any time.
  if (motion.run?.kind === 'unknown') return motion;
  return { ...motion, tracks: retarget(withStart(motion, targets), targets, durationMs, atMs, family) };
}

/** Those of the targets that stand where the board said begin there. */
function withStart({ tracks, told }: Motion, targets: readonly ServoTarget[]): Tracks {
  const standing = targets.flatMap(({ servo }) => {
    const at = told.get(servo);
    return at === undefined || at === null ? [] : [[servo, standingAt(at)] as const];
  });
  return new Map([...standing, ...tracks]);
}

/** It drops, who knows where to. */
function released(motion: Motion, servos: readonly number[]): Motion {
  return { ...motion, tracks: only(motion.tracks, (_, servo) => !servos.includes(servo)) };
}

/** Servos at rest stay; those under way freeze and jump (S29), but they arrive. A group goes on, nobody knows when. */
function deafened(motion: Motion, kind: Command['kind'], atMs: number): Motion {
  const deafUntilMs = atMs + LONGEST_DEAFNESS_MS;
  const deaf = { ...motion, deafUntilMs, answersOwed: answersTo(kind), mayHoldPacket: false };
  if (motion.run !== null) return runningUnknown(deaf, null);
  const tracks = new Map(motion.tracks);
  for (const [servo, track] of tracks) {
    const durationMs = Math.max(endMs(track), deafUntilMs) - track.startMs;
    if (!stands(track, atMs)) tracks.set(servo, { ...track, from: null, durationMs });
  }
  return { ...deaf, tracks };
}

/** It is dropped or comes late: what it may move is not known, and of what moved already only its end was. */
function afterUnheard(motion: Motion, command: Command, atMs: number, { family }: KnownBoard): Motion {
  const owed = family.answers.includes(command.kind) ? answersTo(command.kind) : [];
  const deafUntilMs = owed.length > 0 ? atMs + LONGEST_DEAFNESS_MS : motion.deafUntilMs;
  const answersOwed = [...motion.answersOwed, ...owed];
  const later = { ...motion, deafUntilMs, answersOwed, mayHoldPacket: true };
  if (command.kind === 'run') return runningUnknown(later, null);
  const targets = new Map(
    command.kind === 'move' ? command.targets.map(({ servo, position }) => [servo, position]) : [],
  );
  const freed = command.kind === 'release' ? command.servos : [];
  const tracks = only(
    motion.tracks,
    (track, servo) =>
      stands(track, atMs) && (targets.get(servo) ?? track.to) === track.to && !freed.includes(servo),
  );
  return { ...later, tracks, restlessUntilMs: deafUntilMs + LONGEST_MOVE_MS };
}

/** After the board said so at `atMs`; the end of a group is `afterEnd`. */
export function afterReport(motion: Motion, report: Report, atMs: number, board: KnownBoard): Motion {
  const current = advance(motion, atMs, board);
  if (report.kind === 'runStarted') return afterStart(current, report.slot);
  const answered = afterAnswer(current, report.kind, atMs, board);
  const isWord = report.kind === 'positions' || report.kind === 'allPositions';
  return isWord ? afterWord(answered, report.positions, atMs) : answered;
}

/** It read them a while ago: what may have moved meanwhile it may have read on its way. */
function afterWord(motion: Motion, positions: readonly ServoTarget[], atMs: number): Motion {
  if (motion.run !== null || atMs < motion.restlessUntilMs + LONGEST_DEAFNESS_MS) return motion;
  const standing = positions.filter(({ servo }) => !motion.tracks.has(servo));
  return { ...motion, told: afterPositions(motion.told, standing) };
}

/** What came while it was deaf it takes up only now: until that is done the next packet may be dropped (S9), or it is deaf again. */
function afterAnswer(motion: Motion, kind: ReportKind, atMs: number, { family }: KnownBoard): Motion {
  const index = motion.answersOwed.indexOf(kind);
  if (index < 0) return motion;
  const answersOwed = motion.answersOwed.toSpliced(index, 1);
  if (answersOwed.length > 0) return { ...motion, answersOwed };
  const deafUntilMs = motion.mayHoldPacket ? atMs + family.serviceGapMs : -Infinity;
  return { ...motion, answersOwed, deafUntilMs, mayHoldPacket: false };
}

/** By our own command a moment ago; or somebody started it at the board, and how long ago nobody can tell to the tick. */
function afterStart(motion: Motion, slot: number): Motion {
  const { run } = motion;
  const isOurs = run?.kind === 'deadlines' && run.slot === slot && run.next <= 1 && run.loopsDone === 0;
  return isOurs ? motion : runningUnknown(motion, slot);
}

/** After a group has ended by itself, or was ended behind our back: the one in `slot`, or null where nobody says which. */
export function afterEnd(motion: Motion, slot: number | null, atMs: number, board: KnownBoard): Motion {
  const current = advance(motion, atMs, board);
  const isAnother = current.run?.kind === 'deadlines' && slot !== null && slot !== current.run.slot;
  // Said so late that the next one runs already.
  if (isAnother) return current;
  return restless(current, playbackOf(board).ended(current, board), atMs);
}

/** How long one pass of a group takes at most. */
export function passMs(frames: readonly Frame[], board: KnownBoard): number {
  return playbackOf(board).passMs(frames);
}

/** Nothing is known any more: the robot may have been moved or the board restarted. */
export function forgotten({ deafUntilMs, told }: Motion, atMs: number): Motion {
  return {
    ...UNKNOWN_MOTION,
    told: onlyLetGo(told),
    deafUntilMs,
    restlessUntilMs: atMs + LONGEST_MOVE_MS,
    skipsFirst: 'maybe',
  };
}

/** Present position of a servo in board units, or null while it is unknown. */
export function positionAt(motion: Motion, servo: number, nowMs: number): number | null {
  const track = motion.tracks.get(servo);
  const position = track ? positionOf(track, nowMs) : (motion.told.get(servo) ?? null);
  return position === null ? null : Math.round(position);
}

/** How far off `positionAt` may be, in board units: the way of one tick, and more for a servo redirected on its way. */
export function leewayAt(motion: Motion, servo: number, nowMs: number, family: Family): number {
  const track = motion.tracks.get(servo);
  if (track) return leewayOf(track, nowMs, family);
  return (motion.told.get(servo) ?? null) === null ? Infinity : 0;
}

/** Where a servo was last asked to be, or null when it never was. */
export function targetOf(motion: Motion, servo: number): number | null {
  return motion.tracks.get(servo)?.to ?? null;
}

/** Milliseconds until the moves in progress end; 0 at rest. */
export function remainingMs(motion: Motion, nowMs: number): number {
  return lastEndMs(motion.tracks, nowMs) - nowMs;
}

/** Servos on a way that nobody knows the start of: a hold cannot freeze them (docs/adr/0002). */
export function unheldServos(motion: Motion, nowMs: number): readonly number[] {
  return [...motion.tracks.keys()].filter((servo) => positionAt(motion, servo, nowMs) === null);
}

/** How long a move must take at least, so that no servo whose start is unknown snaps to its target. */
export function gentleMs(
  motion: Motion,
  servos: readonly number[],
  nowMs: number,
  { motion: { timing } }: Family,
): number {
  const unheld = unheldServos(motion, nowMs).filter((servo) => timing === 'shared' || servos.includes(servo));
  return Math.ceil(
    lastEndMs(
      only(motion.tracks, (_, servo) => unheld.includes(servo)),
      nowMs,
    ) - nowMs,
  );
}

/**
 * The one move that freezes the robot where it is at `nowMs`, or null when no position is known. A servo in its first
 * move has no known position: it cannot be frozen, and where the board re-times every servo (S26) the hold takes as long
 * as that move still needs, so that it does not snap to its target.
 */
export function holdMove(
  motion: Motion,
  nowMs: number,
  family: Family,
): { readonly targets: readonly ServoTarget[]; readonly durationMs: number } | null {
  const targets = [...motion.tracks.keys()].flatMap((servo) => {
    const position = positionAt(motion, servo, nowMs);
    return position === null ? [] : [{ servo, position }];
  });
  const held = targets.map(({ servo }) => servo);
  const durationMs = Math.max(family.shortestMoveMs, gentleMs(motion, held, nowMs, family));
  return targets.length === 0 ? null : { targets, durationMs };
}
