// Plays frames from the page: each move on its deadline, counted from the start so that nothing drifts. The way to the
// first frame is gentle. Knows time and moves; no link, no document.

import type { Clock } from '../clock.ts';
import type { Frame } from '../protocol/commands.ts';
import { FIRST_MOVE_MS } from './timings.ts';

export interface PlayerOptions {
  readonly clock: Clock;
  readonly frames: readonly Frame[];
  /** 0: until stopped. */
  readonly times: number;
  /** Until the last servo of the first frame may start. */
  startsWithinMs(first: Frame): number;
  move(frame: Frame): void;
  /** Frame `index` begins. */
  frameBegan(index: number): void;
}

export interface Playing {
  /** Resolves when the last frame has ended or `stop` was called. Rejects with what `move` threw. */
  readonly done: Promise<void>;
  stop(): void;
}

export function play({ clock, frames, times, startsWithinMs, move, frameBegan }: PlayerOptions): Playing {
  let cancelTimer = (): void => undefined;
  let finish = (): void => undefined;
  let failed: (error: unknown) => void = () => undefined;
  const done = new Promise<void>((resolve, reject) => {
    finish = resolve;
    failed = reject;
  });
  let deadlineMs = clock.now();
  let begun = 0;

  function beginNext(): void {
    const index = begun % frames.length;
    const frame = frames[index];
    if (frame === undefined || (times > 0 && begun === times * frames.length)) return finish();
    const isFirst = begun === 0;
    const durationMs = isFirst ? Math.max(frame.durationMs, FIRST_MOVE_MS) : frame.durationMs;
    const waitMs = durationMs + (isFirst ? startsWithinMs(frame) : 0);
    try {
      move({ ...frame, durationMs });
    } catch (error) {
      return failed(error);
    }
    frameBegan(index);
    begun += 1;
    deadlineMs += Math.max(1, waitMs);
    cancelTimer = clock.after(Math.max(0, deadlineMs - clock.now()), beginNext);
  }

  beginNext();
  return {
    done,
    stop() {
      cancelTimer();
      finish();
    },
  };
}
