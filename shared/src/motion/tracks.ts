// Where each servo is on its way: linear, in whole ticks of the board (S25-S27, L5). Knows targets and times; no group, no
// command. The board's ticks fall where nobody can see them, so a servo under way may be one tick off, either way.

import type { ServoTarget } from '../protocol/commands.ts';
import type { Family } from '../protocol/families.ts';

/**
 * One servo's way. `from` is null when nobody knows where it started. A leeway of Infinity says that the position is right only
 * if no group that nobody knows has moved the servo: a guess, good enough to hold it there, not to show it.
 */
export interface Track {
  readonly from: number | null;
  readonly to: number;
  readonly startMs: number;
  readonly durationMs: number;
  /** How far off the two ends may be: a servo whose way is changed or halted keeps what was open then. */
  readonly fromLeeway: number;
  readonly toLeeway: number;
}

export type Tracks = ReadonlyMap<number, Track>;

/** Of every board: S25, L5; of the closed ones nobody knows better. */
export const LONGEST_MOVE_MS = 30_000;

/** The board's own duration: clamped, in whole ticks. */
export function boardDurationMs(durationMs: number, { motion, shortestMoveMs }: Family): number {
  const clamped = Math.min(Math.max(durationMs, shortestMoveMs), LONGEST_MOVE_MS);
  return Math.floor(clamped / motion.tickMs) * motion.tickMs;
}

export function endMs(track: Track): number {
  return track.startMs + track.durationMs;
}

/** A servo that rests there. */
export function standingAt(at: number): Track {
  return { from: at, to: at, startMs: -Infinity, durationMs: 0, fromLeeway: 0, toLeeway: 0 };
}

/** It has arrived, or was there from the start. */
export function stands(track: Track, nowMs: number): boolean {
  return endMs(track) <= nowMs || (track.from === track.to && track.fromLeeway === 0);
}

/** When the last of them arrives; `atMs` where all have. */
export function lastEndMs(tracks: Tracks, atMs: number): number {
  return Math.max(atMs, ...[...tracks.values()].map(endMs));
}

/** Of its time. */
export function shareDone(track: Track, nowMs: number): number {
  return nowMs >= endMs(track) ? 1 : Math.max(0, nowMs - track.startMs) / track.durationMs;
}

/** Exact, not rounded; null where even a guess is impossible. */
export function guessOf(track: Track, nowMs: number): number | null {
  const done = shareDone(track, nowMs);
  if (done === 1) return track.to;
  return track.from === null ? null : track.from + (track.to - track.from) * done;
}

/** The same; null while nobody knows. */
export function positionOf(track: Track, nowMs: number): number | null {
  const leeway = nowMs >= endMs(track) ? track.toLeeway : track.fromLeeway;
  return leeway === Infinity ? null : guessOf(track, nowMs);
}

/** From now on a group that nobody knows may have moved them. */
export function doubted(tracks: Tracks): Tracks {
  const guess = { fromLeeway: Infinity, toLeeway: Infinity };
  return new Map([...tracks].map(([servo, track]) => [servo, { ...track, ...guess }]));
}

/** How far off that may be: its way of one tick, held up by what the board says, and what the ends leave open. */
export function leewayOf(track: Track, nowMs: number, { motion, position }: Family): number {
  const { from, to, durationMs, fromLeeway, toLeeway } = track;
  if (nowMs >= endMs(track) + motion.talkMs) return toLeeway;
  if (fromLeeway === Infinity)
    return nowMs < endMs(track) ? Infinity : position.max - position.min + toLeeway;
  const way = from === null ? position.max - position.min : Math.abs(to - from);
  const tick = Math.min(1, (motion.tickMs + motion.talkMs) / durationMs);
  // What was open at its start the board may have left behind one tick later than we.
  const left = Math.min(1, 1 - shareDone(track, nowMs) + tick);
  return way * tick + toLeeway + (fromLeeway - toLeeway) * left;
}

interface Unrest {
  readonly restlessUntilMs: number;
  readonly inheritedUntilMs: number;
}

/** Where the board re-times every servo, also what nobody knows of arrives with what takes effect at `atMs` (S26). */
export function unrestBehind(
  { restlessUntilMs, inheritedUntilMs }: Unrest,
  requestedMs: number,
  atMs: number,
  family: Family,
): Unrest {
  const { timing, tickMs, talkMs } = family.motion;
  const arrivedMs = atMs + boardDurationMs(requestedMs, family) + tickMs + talkMs;
  const until = (untilMs: number): number => (timing !== 'shared' || untilMs <= atMs ? untilMs : arrivedMs);
  return { restlessUntilMs: until(restlessUntilMs), inheritedUntilMs: until(inheritedUntilMs) };
}

/** The targets of a move or of a frame, and when they take effect and arrive. */
export interface Order {
  readonly targets: readonly ServoTarget[];
  readonly atMs: number;
  readonly endMs: number;
}

export function orderAt(
  targets: readonly ServoTarget[],
  requestedMs: number,
  atMs: number,
  family: Family,
): Order {
  return { targets, atMs, endMs: atMs + boardDurationMs(requestedMs, family) };
}

/** After a move and a frame so close that the board may have taken either first: which of two targets a servo has got, nobody knows. */
export function contested(
  tracks: Tracks,
  one: Order | null,
  other: Order | null,
  { motion }: Family,
): Tracks {
  if (one === null || other === null) return tracks;
  if (Math.abs(one.atMs - other.atMs) > motion.tickMs + motion.talkMs) return tracks;
  const wanted = new Map(other.targets.map(({ servo, position }) => [servo, position]));
  const next = new Map(tracks);
  for (const { servo, position } of one.targets) {
    const track = tracks.get(servo);
    if (track === undefined || (wanted.get(servo) ?? position) === position) continue;
    const durationMs = Math.max(one.endMs, other.endMs) - track.startMs;
    next.set(servo, { ...track, from: null, durationMs, fromLeeway: Infinity, toLeeway: Infinity });
  }
  return next;
}

/** Its way from `atMs` on to `to`. */
function redirected(
  track: Track | undefined,
  to: number,
  atMs: number,
  durationMs: number,
  family: Family,
): Track {
  const from = track ? positionOf(track, atMs) : null;
  const guess = track ? guessOf(track, atMs) : null;
  // Sent to where it is guessed to be, it is held there.
  if (from === null && guess !== null && Math.abs(guess - to) <= 1)
    return { from: to, to, startMs: atMs, durationMs, fromLeeway: Infinity, toLeeway: 0 };
  const carried = track && from !== null ? leewayOf(track, atMs, family) : 0;
  // Positions are whole numbers to the board, wherever it cuts a way short.
  const fromLeeway = carried === 0 ? 0 : carried + 1;
  return { from, to, startMs: atMs, durationMs, fromLeeway, toLeeway: 0 };
}

/** Its way goes on as a guess. */
function guessed(track: Track | undefined, to: number, atMs: number, durationMs: number): Track {
  const from = track ? guessOf(track, atMs) : null;
  return { from, to, startMs: atMs, durationMs, fromLeeway: Infinity, toLeeway: Infinity };
}

/** After new targets took effect at `atMs`; `isSure` false where a group that nobody knows may overrule them. */
export function retarget(
  tracks: Tracks,
  targets: readonly ServoTarget[],
  requestedMs: number,
  atMs: number,
  family: Family,
  isSure = true,
): Tracks {
  if (targets.length === 0) return tracks;
  const durationMs = boardDurationMs(requestedMs, family);
  const next = new Map(tracks);
  const aim = (servo: number, to: number, sure: boolean): void => {
    const track = tracks.get(servo);
    const way = sure ? redirected(track, to, atMs, durationMs, family) : guessed(track, to, atMs, durationMs);
    next.set(servo, way);
  };
  if (family.motion.timing === 'shared')
    tracks.forEach((track, servo) => {
      const isSure = Number.isFinite(track.toLeeway);
      // A guess that has arrived goes nowhere.
      if (isSure || endMs(track) > atMs) aim(servo, track.to, isSure);
    });
  for (const { servo, position } of targets) aim(servo, position, isSure);
  return next;
}

/** After a stop: those that it halts are where they were. */
export function frozen(tracks: Tracks, family: Family, atMs: number): Tracks {
  const next = new Map(tracks);
  for (const servo of family.motion.haltedByStop) {
    const track = tracks.get(servo);
    if (!track || endMs(track) <= atMs) continue;
    const to = positionOf(track, atMs);
    const toLeeway = leewayOf(track, atMs, family) + 1;
    if (to === null) next.delete(servo);
    else next.set(servo, { from: to, to, startMs: atMs, durationMs: 0, fromLeeway: toLeeway, toLeeway });
  }
  return next;
}

/** Those of the tracks that `keep` says. */
export function only(tracks: Tracks, keep: (track: Track, servo: number) => boolean): Tracks {
  return new Map([...tracks].filter(([servo, track]) => keep(track, servo)));
}
