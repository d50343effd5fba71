// Plays stored groups on deadlines (S42-S50). Knows frames and the loop's time; does not know packets or servo motion.

import type { Frame } from '../codec/commands.ts';
import type { Work } from './agenda.ts';

export interface Runner {
  /** A run command: what it does depends on what runs already (S44-S47). */
  request(slot: number, times: number): Work;
  /** The frame in progress completes all the same (S50). */
  stop(): Work;
  /** What one pass of the main loop does for the group. */
  step(): Work;
  dueMs(): number;
  readonly runningSlot: () => number | null;
  /** The frame that begins within so many milliseconds, unless a stop keeps it from that. */
  readonly dueFrame: (withinMs: number) => Frame | null;
}

/** What the board says of a run by itself; empty work where it says nothing. */
export interface RunReports {
  readonly started: (slot: number, times: number) => Work;
  /** Only where a group was running. */
  readonly stopped: () => Work;
  /** The group ended by itself (S48). */
  readonly ended: (slot: number, times: number) => Work;
}

interface RunnerParts {
  readonly now: () => number;
  readonly frameCount: (slot: number) => number;
  /** Null where the frame cannot be played. */
  readonly frame: (slot: number, frameIndex: number) => Frame | null;
  readonly issue: (frame: Frame) => Work;
  readonly reports: RunReports;
  /** When this group ends by itself, the next one starts once (S49); null where the board does not chain. */
  readonly chainedSlot: number | null;
}

/** Group 0 pre-empts any other (S47). */
const PREEMPTIVE_SLOT = 0;
/** Fetching a frame over SPI and taking its entries; keeps an endless group of zero-time frames from taking no time. */
const FRAME_FETCH_MS = 0.1;

export function createRunner(parts: RunnerParts): Runner {
  const { now, frameCount, frame, issue, reports, chainedSlot } = parts;
  let running = false;
  let slot = 0;
  let frameTotal = 0;
  let frameIndex = 0;
  let frameIssued = false;
  let deadlineMs = 0;
  let times = 0;
  let loopsDone = 0;

  function start(requestedSlot: number): void {
    running = true;
    slot = requestedSlot;
    frameIndex = 0;
    frameIssued = false;
    loopsDone = 0;
    deadlineMs = now();
  }

  function* request(requestedSlot: number, requestedTimes: number): Work {
    const total = frameCount(requestedSlot);
    if (total === 0) return;
    // Before anything is decided: this is how another group cuts the running one short (S46).
    frameTotal = total;
    const preempts = requestedSlot === PREEMPTIVE_SLOT && slot !== PREEMPTIVE_SLOT;
    if (!running || preempts) {
      yield* reports.started(requestedSlot, requestedTimes);
      start(requestedSlot);
    }
    if (requestedSlot === slot) times = requestedTimes;
  }

  function* issueFrame(): Work {
    const next = frame(slot, frameIndex);
    if (!next) {
      running = false;
      return;
    }
    yield FRAME_FETCH_MS;
    frameIssued = true;
    // The raw time, not the one the servos were given (S43).
    deadlineMs += next.durationMs;
    yield* issue(next);
  }

  function* endLoop(): Work {
    frameIndex = 0;
    if (times === 0) return;
    loopsDone += 1;
    if (loopsDone < times) return;
    yield* reports.ended(slot, times);
    running = false;
    if (slot === chainedSlot) yield* request(chainedSlot + 1, 1);
  }

  function* stop(): Work {
    if (!running) return;
    running = false;
    yield* reports.stopped();
  }

  function* step(): Work {
    if (!running) return;
    if (!frameIssued) {
      yield* issueFrame();
      return;
    }
    if (now() < deadlineMs) return;
    frameIssued = false;
    frameIndex += 1;
    if (frameIndex >= frameTotal) yield* endLoop();
  }

  function dueMs(): number {
    if (!running) return Infinity;
    return frameIssued ? deadlineMs : 0;
  }

  function dueFrame(withinMs: number): Frame | null {
    if (!running || (frameIssued && deadlineMs - now() > withinMs)) return null;
    const next = frameIssued ? frameIndex + 1 : frameIndex;
    if (next < frameTotal) return frame(slot, next);
    return times === 0 || loopsDone + 1 < times ? frame(slot, 0) : null;
  }

  return {
    request,
    stop,
    step,
    dueMs,
    runningSlot: () => (running ? slot : null),
    dueFrame,
  };
}
