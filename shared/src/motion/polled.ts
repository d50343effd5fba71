// Groups without deadlines: LeArm looks now and then whether all servos have arrived, then begins the next frame (L6-L11).
// The time of that is uncertain by a tick, so of a group only the first frame is known, and where it ends. Knows runs; no
// servo's way.

import timings from '../../protocol/timings.json' with { type: 'json' };
import type { Frame } from '../codec/commands.ts';
import {
  runningUnknown,
  type KnownBoard,
  type Motion,
  type Playback,
  type PolledRun,
  type RunRequest,
} from './model.ts';
import { boardDurationMs, frozen, lastEndMs, LONGEST_MOVE_MS, retarget, type Tracks } from './tracks.ts';

const POLL_MS = timings.estimate.pollMs;
const STEP_MS = timings.estimate.pollStepMs;
const SPARE_POLLS = timings.estimate.sparePolls;
const NOWHERE = { fromLeeway: Infinity, toLeeway: Infinity };

/** By then the next frame has begun; the first servo may not have moved before. */
function latestMs(frame: Frame): number {
  return (Math.ceil(frame.durationMs / STEP_MS) + SPARE_POLLS) * POLL_MS;
}

/** A frame that moves nothing is over at once. */
function surelyMs(frame: Frame, board: KnownBoard): number {
  return frame.targets.length === 0 ? 0 : boardDurationMs(frame.durationMs, board.family);
}

function sum(frames: readonly Frame[], timeOf: (frame: Frame) => number): number {
  return frames.reduce((total, frame) => total + timeOf(frame), 0);
}

function lastTargets(frames: readonly Frame[]): ReadonlyMap<number, number> {
  return new Map(frames.flatMap(({ targets }) => targets.map(({ servo, position }) => [servo, position])));
}

interface Order {
  readonly first: Frame;
  readonly behind: readonly Frame[];
  readonly passesLeft: number;
  readonly frames: readonly Frame[];
}

/** The frames of a request: the first, those behind it in its pass, and how many whole passes follow; null for none. */
function orderOfPlay(frames: readonly Frame[], times: number, skipsFirst: boolean): Order | null {
  // One byte, and 0 means once (L6).
  const passes = times & 0xff || 1;
  // Skipping the only frame skips a pass.
  const index = skipsFirst ? 1 % frames.length : 0;
  const passesLeft = passes - (skipsFirst && index === 0 ? 2 : 1);
  const first = frames[index];
  return first === undefined || passesLeft < 0
    ? null
    : { first, behind: frames.slice(index + 1), passesLeft, frames };
}

function request(motion: Motion, { slot, times }: RunRequest, atMs: number, board: KnownBoard): Motion {
  const frames = board.playedFrames(slot);
  const next = { ...motion, skipsFirst: 'no' } as const;
  // What becomes of a run when the next one comes is unknown.
  if (frames === null || motion.run !== null) return runningUnknown(next, slot);
  const order = orderOfPlay(frames, times, motion.skipsFirst === 'yes');
  if (order === null) return next;
  if (motion.skipsFirst !== 'maybe') return begin(next, order, atMs, board);
  return beginEither(next, order, orderOfPlay(frames, times, true), atMs, board);
}

/** Before the first frame, too, it may wait until all servos have arrived. */
function begin(motion: Motion, order: Order, atMs: number, board: KnownBoard): Motion {
  const { first } = order;
  const restedMs = Math.max(lastEndMs(motion.tracks, atMs), motion.restlessUntilMs);
  if (restedMs > atMs) return { ...motion, run: runOf(order, [first], atMs, restedMs, atMs, board) };
  const tracks = retarget(motion.tracks, first.targets, first.durationMs, atMs, board.family);
  const arrivedMs = lastEndMs(tracks, atMs);
  return {
    ...motion,
    tracks,
    run: runOf(order, [], arrivedMs, arrivedMs, atMs + surelyMs(first, board), board),
  };
}

/** It may or may not play `less`: it moves its servos from now on, as long as `whole` takes, to the end of one or the other. */
function beginEither(
  motion: Motion,
  whole: Order,
  less: Order | null,
  atMs: number,
  board: KnownBoard,
): Motion {
  const restedMs = Math.max(lastEndMs(motion.tracks, atMs), motion.restlessUntilMs);
  const runFor = (order: Order): PolledRun => runOf(order, [order.first], atMs, restedMs, atMs, board);
  const run = runFor(whole);
  const shorter = less === null ? null : runFor(less);
  const unsure = [...run.rest]
    .filter(([servo, to]) => shorter?.rest.get(servo) !== to)
    .map(([servo]) => servo);
  const surelyUntilMs = shorter?.surelyUntilMs ?? atMs;
  return { ...motion, run: { ...run, restAtMs: atMs, surelyUntilMs, unsure: new Set(unsure) } };
}

/** `ahead` and all behind it come somewhen after `restAtMs`, and no later than counted from `countedMs`. */
function runOf(
  { behind, frames, passesLeft }: Order,
  ahead: readonly Frame[],
  restAtMs: number,
  countedMs: number,
  surelyMsSoFar: number,
  board: KnownBoard,
): PolledRun {
  const pass = [...ahead, ...behind];
  const total = (timeOf: (frame: Frame) => number): number =>
    sum(pass, timeOf) + passesLeft * sum(frames, timeOf);
  return {
    kind: 'polled',
    rest: lastTargets(passesLeft > 0 ? [...pass, ...frames] : pass),
    restAtMs,
    surelyUntilMs: surelyMsSoFar + total((frame) => surelyMs(frame, board)),
    restedMs: countedMs,
    longestMs: Math.max(...frames.map((frame) => surelyMs(frame, board))),
    endMs: countedMs + SPARE_POLLS * POLL_MS + total(latestMs),
    unsure: new Set(),
    isBlurred: false,
  };
}

/** Behind the first frame each servo is somewhere until the run is over for sure. */
function blur(motion: Motion, run: PolledRun): Motion {
  const tracks = new Map(motion.tracks);
  const way = { from: null, startMs: run.restAtMs, durationMs: run.endMs - run.restAtMs };
  const sure = { fromLeeway: 0, toLeeway: 0 };
  for (const [servo, to] of run.rest)
    tracks.set(servo, { ...way, to, ...(run.unsure.has(servo) ? NOWHERE : sure) });
  return { ...motion, tracks, run: { ...run, isBlurred: true } };
}

function advance(motion: Motion, nowMs: number): Motion {
  const { run } = motion;
  if (run?.kind !== 'polled' || nowMs < run.restAtMs) return motion;
  const blurred = run.isBlurred ? motion : blur(motion, run);
  return nowMs < run.endMs ? blurred : { ...blurred, run: null };
}

/** No further frame begins; which one is in progress is known of the first alone. */
function cut(motion: Motion, atMs: number): Motion {
  const { run } = motion;
  if (run === null) return motion;
  if (run.kind !== 'polled') return { ...motion, run: null, restlessUntilMs: atMs + LONGEST_MOVE_MS };
  if (atMs < run.restAtMs || run.rest.size === 0) return { ...motion, run: null };
  const untilMs = Math.min(run.endMs, Math.max(run.restedMs, atMs + run.longestMs));
  return { ...motion, run: null, tracks: new Map([...motion.tracks, ...lostWays(run, untilMs)]) };
}

/** On their way to one of its places, it is unknown which. */
function lostWays({ rest, restAtMs }: PolledRun, untilMs: number): Tracks {
  const way = { from: null, startMs: restAtMs, durationMs: untilMs - restAtMs };
  return new Map([...rest].map(([servo, to]) => [servo, { ...way, to, ...NOWHERE }]));
}

/** The group dies, unsaid (L8), and leaves its place in the frames behind (L11). */
function interrupt(motion: Motion, atMs: number): Motion {
  const { run } = motion;
  if (run === null) return motion;
  const surely = run.kind === 'polled' && atMs < run.surelyUntilMs;
  return { ...cut(motion, atMs), skipsFirst: surely ? 'yes' : 'maybe' };
}

function stop(motion: Motion, atMs: number, { family }: KnownBoard): Motion {
  const { tracks, ...stopped } = cut(motion, atMs);
  return { ...stopped, tracks: frozen(tracks, family, atMs) };
}

export const polled: Playback = {
  request,
  advance,
  stop,
  interrupt,
  // It reports no end (L6).
  ended: (motion) => motion,
  passMs: (frames) => sum(frames, latestMs),
};
