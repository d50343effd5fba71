// Where each servo is on its way: linear, in whole ticks of the board (S25-S27, L5). Knows targets and times; no group, no
// command. The times of the board's ticks are unknown, so a servo under way may be one tick off, either way.

import timings from '../../protocol/timings.json' with { type: 'json' };
import type { ServoTarget } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';

/** One servo's way. `from` is null when it is unknown where it started. */
export interface Track {
  readonly from: number | null;
  readonly to: number;
  readonly startMs: number;
  readonly durationMs: number;
  /**
   * How far off the two ends may be: a servo whose way is changed or halted keeps what was open then. Where one is Infinity, the place is
   * unknown, and the way says only until when the servo may move.
   */
  readonly fromLeeway: number;
  readonly toLeeway: number;
}

export type Tracks = ReadonlyMap<number, Track>;

export const LONGEST_MOVE_MS = timings.move.longestMs;

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

/** A servo that sets out then, from anywhere. */
export function startingAt(to: number, atMs: number): Track {
  return astray(to, atMs, 0);
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

/** Exact, not rounded; null while unknown. */
export function positionOf(track: Track, nowMs: number): number | null {
  const { from, to, fromLeeway, toLeeway } = track;
  const done = shareDone(track, nowMs);
  if (done === 1) return toLeeway === Infinity ? null : to;
  return from === null || fromLeeway === Infinity ? null : from + (to - from) * done;
}

/** A way until then, of which no place is known. */
function astray(to: number, startMs: number, durationMs: number): Track {
  return { from: null, to, startMs, durationMs, fromLeeway: Infinity, toLeeway: Infinity };
}

/** An unknown group may move these servos from now on: their places are void, only their times stay. */
export function doubted(tracks: Tracks): Tracks {
  return new Map(
    [...tracks].map(([servo, { to, startMs, durationMs }]) => [servo, astray(to, startMs, durationMs)]),
  );
}

/** How far off that may be: its way of one tick, held up by what the board says, and what the ends leave open. */
export function leewayOf(track: Track, nowMs: number, { motion, position }: Family): number {
  const { from, to, durationMs, fromLeeway, toLeeway } = track;
  if (nowMs >= endMs(track) + motion.talkMs) return toLeeway;
  if (fromLeeway === Infinity) return Infinity;
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

/** Where the board re-times every servo, also unknown moves arrive with what takes effect at `atMs` (S26). */
export function unrestBehind(
  { restlessUntilMs, inheritedUntilMs }: Unrest,
  requestedMs: number,
  atMs: number,
  family: Family,
): Unrest {
  const { timing, tickMs, talkMs } = family.motion;
  const arrivedMs = atMs + boardDurationMs(requestedMs, family) + tickMs + talkMs;
  const until = (untilMs: number): number => {
    if (timing === 'perServo' || untilMs <= atMs) return untilMs;
    return timing === 'shared' ? arrivedMs : Math.max(untilMs, arrivedMs);
  };
  return { restlessUntilMs: until(restlessUntilMs), inheritedUntilMs: until(inheritedUntilMs) };
}

/** The targets of a move or of a frame, when they take effect and arrive, and what was under way before. */
export interface Order {
  readonly by: 'move' | 'frame';
  readonly targets: readonly ServoTarget[];
  readonly atMs: number;
  readonly endMs: number;
  readonly before: Tracks;
}

/** The board may take up orders that are no farther apart in another order than they are computed in. */
function isNear(order: Order, atMs: number, { motion }: Family): boolean {
  return atMs - order.atMs <= motion.tickMs + motion.talkMs;
}

/** `order` behind those that are near it. */
export function ordered(
  recent: readonly Order[],
  order: Omit<Order, 'endMs'>,
  requestedMs: number,
  family: Family,
): readonly Order[] {
  const near = recent.filter((other) => isNear(other, order.atMs, family));
  return [...near, { ...order, endMs: order.atMs + boardDurationMs(requestedMs, family) }];
}

/** It arrives, but from where and when is unknown: by then at the latest. */
export function lengthened(track: Track, untilMs: number): Track {
  return { ...track, from: null, durationMs: Math.max(endMs(track), untilMs) - track.startMs };
}

/** Somewhere on its way to one of two places, until the later of two times. */
export function torn(track: Track, untilMs: number): Track {
  return { ...lengthened(track, untilMs), fromLeeway: Infinity, toLeeway: Infinity };
}

/**
 * After the last of `recent`, where moves and frames are near it that the board may take up behind it: a servo that they send elsewhere
 * goes to one of two places, and where each re-times every servo (S26) whatever is under way may arrive when they end. What the board
 * heard before `sinceMs` is ahead of it for sure.
 */
export function contested(
  tracks: Tracks,
  recent: readonly Order[],
  family: Family,
  sinceMs = -Infinity,
): Tracks {
  const latest = recent.at(-1);
  if (latest === undefined || latest.targets.length === 0) return tracks;
  const rivals = recent.filter(({ by, targets }) => by !== latest.by && targets.length > 0);
  const retimers = family.motion.timing === 'shared' ? rivals.filter(({ atMs }) => atMs >= sinceMs) : [];
  const next = new Map(tracks);
  for (const [servo, track] of tracks) {
    const against = rivals.filter((rival) => contests(rival, latest, servo));
    const behind = [...against, ...retimers].map((rival) => rival.endMs);
    if (against.length > 0) next.set(servo, torn(track, Math.max(...behind)));
    else if (!stands(track, latest.atMs) && behind.some((untilMs) => untilMs !== endMs(track)))
      next.set(servo, lengthened(track, Math.max(...behind)));
  }
  return next;
}

/** Both send it, and to different places. */
function contests(one: Order, other: Order, servo: number): boolean {
  const sent = [...one.targets, ...other.targets].filter((target) => target.servo === servo);
  return new Set(sent.map(({ position }) => position)).size > 1;
}

/**
 * After a stop at `atMs`: frames that began just before it may not have begun. Then the motion under way continues, and what stood still
 * stands; that a hold would throw to where a frame has sent it that is too short to need one.
 */
export function stoppedBefore(
  tracks: Tracks,
  recent: readonly Order[],
  atMs: number,
  family: Family,
): Tracks {
  const next = new Map(tracks);
  for (const frame of recent.filter(({ by }) => by === 'frame'))
    if (isNear(frame, atMs, family)) {
      for (const { servo } of frame.targets) {
        const track = next.get(servo);
        // Nothing else has moved it: it may still be anywhere.
        if (track && !frame.before.has(servo)) next.set(servo, torn(track, endMs(track)));
      }
      for (const [servo, former] of frame.before) {
        const track = next.get(servo);
        if (!track) continue;
        const isElsewhere = former.to !== track.to;
        const isOpen = stands(former, frame.atMs)
          ? isElsewhere && endMs(track) <= atMs + timings.stop.heldWithinMs
          : isElsewhere || endMs(former) > endMs(track);
        if (isOpen) next.set(servo, torn(track, endMs(former)));
      }
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
  const carried = track && from !== null ? leewayOf(track, atMs, family) : 0;
  // Positions are whole numbers to the board, wherever it cuts a way short.
  const fromLeeway = carried === 0 ? 0 : carried + 1;
  return { from, to, startMs: atMs, durationMs, fromLeeway, toLeeway: 0 };
}

/** After new targets took effect at `atMs`; `isSure` false where an unknown group may overrule them. */
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
    next.set(servo, sure ? redirected(track, to, atMs, durationMs, family) : astray(to, atMs, durationMs));
  };
  if (family.motion.timing === 'shared')
    tracks.forEach((track, servo) => {
      const isSure = Number.isFinite(track.toLeeway);
      // One of unknown place that has surely arrived goes nowhere.
      if (isSure || endMs(track) + family.motion.tickMs + family.motion.talkMs > atMs)
        aim(servo, track.to, isSure);
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
