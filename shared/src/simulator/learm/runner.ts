// Plays LeArm's groups: no deadlines, it looks every 110 ms whether all servos have arrived (L6-L11). Knows frames and
// time; no packet.

import type { Frame } from '../../codec/commands.ts';

export interface LearmRunner {
  readonly request: (slot: number, times: number) => void;
  readonly stop: () => void;
  /** Another command took the place of the run (L8). */
  readonly kill: () => void;
  readonly step: () => void;
  readonly dueMs: () => number;
  readonly runningSlot: () => number | null;
}

export interface LearmRunnerParts {
  readonly now: () => number;
  readonly frameCount: (slot: number) => number;
  /** Null where the frame cannot be played. */
  readonly frame: (slot: number, frameIndex: number) => Frame | null;
  readonly issue: (frame: Frame) => void;
  /** Whether that frame has ended, so many polls after it began. */
  readonly isOver: (frame: Frame, polls: number) => boolean;
}

/** About; the real one jitters (L7). */
const POLL_MS = 110;
/** Before the first frame only the servos can keep it waiting. */
const STANDING: Frame = { durationMs: 0, targets: [] };

export function createLearmRunner({ now, frameCount, frame, issue, isOver }: LearmRunnerParts): LearmRunner {
  let slot: number | null = null;
  let frameTotal = 0;
  let frameIndex = 0;
  let loopsLeft = 0;
  let pollMs = Infinity;
  let playing: Frame | null = null;
  let polls = 0;
  /** The next run takes the killed one's frame for its own and goes on behind it (L11). */
  let stale = false;

  function request(requestedSlot: number, times: number): void {
    frameTotal = frameCount(requestedSlot);
    slot = frameTotal === 0 ? null : requestedSlot;
    // Eight bits, and 0 means once: so does 256 (L6).
    loopsLeft = times & 0xff || 1;
    frameIndex = stale ? 1 : 0;
    stale = false;
    pollMs = now();
    playing = null;
  }

  function kill(): void {
    stale ||= slot !== null;
    slot = null;
  }

  function advance(runningSlot: number): void {
    if (frameIndex >= frameTotal) {
      frameIndex = 0;
      loopsLeft -= 1;
    }
    if (loopsLeft === 0) {
      slot = null;
      return;
    }
    const next = frame(runningSlot, frameIndex);
    frameIndex += 1;
    // The run hangs until a stop (L10).
    if (next === null) pollMs = Infinity;
    else begin(next);
  }

  function begin(next: Frame): void {
    issue(next);
    playing = next;
    polls = 0;
  }

  function step(): void {
    if (slot === null || now() < pollMs) return;
    pollMs += POLL_MS;
    polls += 1;
    if (playing === null ? isOver(STANDING, polls) : isOver(playing, polls)) advance(slot);
  }

  return {
    request,
    stop: () => void (slot = null),
    kill,
    step,
    dueMs: () => (slot === null ? Infinity : pollMs),
    runningSlot: () => slot,
  };
}
