// Groups on deadlines: a frame begins when the time of the one before it is over (S42-S50). The open firmware's way; of the
// closed boards it is unknown, and the simulated ones do the same. Knows runs; no servo's way.

import timings from '../../protocol/timings.json' with { type: 'json' };
import { wireMs } from '../codec/packet.ts';
import type { Family } from '../codec/families.ts';
import {
  runningUnknown,
  type DeadlineRun,
  type KnownBoard,
  type Motion,
  type Playback,
  type RunRequest,
} from './model.ts';
import { contested, ordered, retarget, stoppedBefore, unrestBehind } from './tracks.ts';

const BARE_PACKET_MS = wireMs(4);
const RUN_REPORT_MS = wireMs(7);

/** What the board says before it looks for the group (S18, X1): it sends by busy-waiting (S21). */
function announcementMs({ runReportsNameSlot, answers }: Family): number {
  if (runReportsNameSlot) return RUN_REPORT_MS;
  return answers.includes('run') ? BARE_PACKET_MS : 0;
}

/** The end of the group before may be said while the next one runs, and then not which it was. */
function owesEnd({ unreportedEndMs }: Motion, atMs: number, { family }: KnownBoard): boolean {
  return !family.runReportsNameSlot && atMs - unreportedEndMs < timings.estimate.endReportedWithinMs;
}

/** A run that begins at `atMs`. */
function begin(
  motion: Motion,
  { slot, times }: RunRequest,
  atMs: number,
  board: KnownBoard,
  endsToHear = 1,
): Motion {
  const total = board.playedFrames(slot)?.length;
  const ends = endsToHear + (owesEnd(motion, atMs, board) ? 1 : 0);
  if (total === undefined) return runningUnknown(motion, slot, ends);
  const at = { requestedAtMs: atMs, nextAtMs: atMs, passAtMs: atMs };
  return {
    ...motion,
    unreportedEndMs: -Infinity,
    run: { kind: 'deadlines', slot, total, next: 0, ...at, times, loopsDone: 0, endsToHear: ends },
  };
}

/** Running it does nothing, and the board says nothing of it (S44). */
function isEmpty(slot: number, board: KnownBoard): boolean {
  return board.playedFrames(slot)?.length === 0;
}

/** While another group runs: its length is overwritten, whatever comes of the request (S45, S46). */
function requestDuring(
  motion: Motion,
  run: DeadlineRun,
  { slot, times }: RunRequest,
  board: KnownBoard,
): Motion {
  const total = board.playedFrames(slot)?.length;
  if (total === undefined) return runningUnknown(motion, null);
  return { ...motion, run: { ...run, total, times: slot === run.slot ? times : run.times } };
}

function request(motion: Motion, wanted: RunRequest, atMs: number, board: KnownBoard): Motion {
  const { run } = motion;
  if (isEmpty(wanted.slot, board)) return motion;
  if (run !== null && run.kind !== 'deadlines') return runningUnknown(motion, null);
  const preempts =
    wanted.slot === timings.estimate.preemptiveSlot && run?.slot !== timings.estimate.preemptiveSlot;
  if (run !== null && !preempts) return requestDuring(motion, run, wanted, board);
  return begin(motion, wanted, atMs + announcementMs(board.family), board);
}

/** What stands behind the last stored frame is erased flash: the run ends there, unsaid (S35, S46). */
function beginFrame(motion: Motion, run: DeadlineRun, board: KnownBoard): Motion {
  const frames = board.playedFrames(run.slot);
  if (frames === null) return runningUnknown(motion, run.slot, run.endsToHear);
  const frame = frames[run.next];
  if (frame === undefined) return { ...motion, run: null };
  const { family } = board;
  const { targets, durationMs } = frame;
  const order = { by: 'frame', targets, atMs: run.nextAtMs, before: motion.tracks } as const;
  const recent = ordered(motion.recent, order, durationMs, family);
  const tracks = retarget(motion.tracks, targets, durationMs, run.nextAtMs, family);
  const isPause = targets.length === 0;
  return {
    ...motion,
    recent,
    tracks: contested(tracks, recent, family, run.requestedAtMs),
    ...(isPause ? {} : unrestBehind(motion, durationMs, run.nextAtMs, family)),
    // The raw time, not the one the servos were given (S43).
    run: { ...run, next: run.next + 1, nextAtMs: run.nextAtMs + durationMs },
  };
}

/** Loops done while endless are not counted (S45). */
function endPass(motion: Motion, run: DeadlineRun, board: KnownBoard): Motion {
  const loopsDone = run.times === 0 ? run.loopsDone : run.loopsDone + 1;
  if (run.times !== 0 && loopsDone >= run.times) return endRun(motion, run, board);
  // Without any time it goes round as fast as the board's loop, and it is unknown how fast that is.
  if (run.nextAtMs === run.passAtMs) return runningUnknown(motion, run.slot, run.endsToHear);
  return { ...motion, run: { ...run, next: 0, passAtMs: run.nextAtMs, loopsDone } };
}

/** The next one is played once (S49), unless there is none. */
function isChained(slot: number | null, board: KnownBoard): boolean {
  const { chainedSlot } = board.family.motion;
  return chainedSlot !== null && (slot ?? chainedSlot) === chainedSlot && !isEmpty(chainedSlot + 1, board);
}

function endRun(motion: Motion, run: DeadlineRun, board: KnownBoard): Motion {
  const ended = { ...motion, run: null };
  if (!isChained(run.slot, board)) return { ...ended, unreportedEndMs: run.nextAtMs };
  // Its own end, still to be heard, and the next one's.
  return begin(
    ended,
    { slot: run.slot + 1, times: 1 },
    run.nextAtMs + BARE_PACKET_MS,
    board,
    run.endsToHear + 1,
  );
}

function step(motion: Motion, run: DeadlineRun, board: KnownBoard): Motion {
  return run.next < run.total ? beginFrame(motion, run, board) : endPass(motion, run, board);
}

function advance(motion: Motion, nowMs: number, board: KnownBoard): Motion {
  let current = motion;
  while (current.run?.kind === 'deadlines' && current.run.nextAtMs <= nowMs)
    current = step(current, current.run, board);
  return current;
}

/** The board knows better than our clock; but each end it reports is only one of those it owes. */
function ended(motion: Motion, board: KnownBoard): Motion {
  const { run } = motion;
  if (run === null) return { ...motion, unreportedEndMs: -Infinity };
  if (run.kind === 'polled') return motion;
  if (run.endsToHear > 1) return { ...motion, run: { ...run, endsToHear: run.endsToHear - 1 } };
  const { chainedSlot } = board.family.motion;
  return chainedSlot !== null && isChained(run.slot, board)
    ? runningUnknown(motion, chainedSlot + 1)
    : { ...motion, run: null };
}

export const deadlines: Playback = {
  request,
  advance,
  // The frame in progress continues to its end (S50), and none begins behind it.
  stop: (motion, atMs, { family }) => ({
    ...{ ...motion, run: null },
    tracks: stoppedBefore(motion.tracks, motion.recent, atMs, family),
    recent: motion.recent.filter(({ by }) => by === 'move'),
  }),
  interrupt: (motion) => motion,
  ended,
  passMs: (frames) => frames.reduce((sum, { durationMs }) => sum + durationMs, 0),
};
