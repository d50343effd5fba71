// Stops besides those of STOP: the repeats of one, and one more for a board that may not have heard it. While it works on its flash
// or talks to its servos a board keeps one packet and drops the others (S9, S41, S53). Knows time and the one packet.

import { sleep, type Clock } from '../clock.ts';
import { encodeCommand } from '../codec/encode.ts';
import { UNKNOWN_BOARD } from '../codec/families.ts';
import { wireMs } from '../codec/packet.ts';
import { STOP_EVERY_MS, STOP_REPEATS } from './timings.ts';

/** The same on every board, so also on one that is not identified yet. */
export const STOP_PACKET = encodeCommand({ kind: 'stop' }, UNKNOWN_BOARD);

/** Resolves when that packet has left the wire, ahead of all else that waits. */
type SendFirst = (packet: Uint8Array) => Promise<void>;

/** Resolves, when it has left, with the time at which it began to. */
export async function sendStop(clock: Clock, send: SendFirst): Promise<number> {
  await send(STOP_PACKET);
  return clock.now() - wireMs(STOP_PACKET.length);
}

/**
 * Sends a stop now, and repeats of it: each begins to leave so long after the one before, or later where the wire is taken. Two that
 * are closer may both fall into the time in which a board hears none (S54). No more of them leave once `isWanted` says no.
 */
export async function repeatStop(
  clock: Clock,
  send: SendFirst,
  isWanted = (): boolean => true,
): Promise<void> {
  for (let repeat = 0; repeat <= STOP_REPEATS && isWanted(); repeat += 1) {
    const begunMs = await sendStop(clock, send);
    if (repeat < STOP_REPEATS) await sleep(clock, Math.max(0, begunMs + STOP_EVERY_MS - clock.now()));
  }
}

export interface StopAgain {
  /** A stop has left. */
  stopped(): void;
  /** The board has said something: it may hear from now on. */
  heard(): void;
  /** The line is down, or the board is another one. */
  void(): void;
}

/** `deafUntilMs`: until then the board may miss a stop. `stop` sends it once more. */
export function createStopAgain(clock: Clock, deafUntilMs: () => number, stop: () => void): StopAgain {
  let cancelTimer: (() => void) | null = null;

  function clear(): void {
    cancelTimer?.();
    cancelTimer = null;
  }

  function plan(): void {
    clear();
    cancelTimer = clock.after(Math.max(0, deafUntilMs() - clock.now()), () => {
      cancelTimer = null;
      stop();
    });
  }

  return {
    stopped() {
      if (clock.now() < deafUntilMs()) plan();
      else clear();
    },
    heard() {
      if (cancelTimer !== null) plan();
    },
    void: clear,
  };
}
