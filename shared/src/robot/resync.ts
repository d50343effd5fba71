// What a board may have missed is sent again: the end of a packet that a lost link cut, and one more stop behind flash work, during which a
// board keeps one packet and drops the others (S9, S41, S53). Knows no link.

import timings from '../../protocol/timings.json' with { type: 'json' };
import type { Clock } from '../clock.ts';
import { COMMAND_NUMBER } from '../codec/commands.ts';
import type { Queue } from './queue.ts';

interface Resync {
  /** The link went while this packet was on its way to a board that bears this filler, or none. */
  cut(packet: Uint8Array, filler: number | null): void;
  /** The link is ready: the filler goes first, whatever is sent afterwards. */
  send(): void;
}

const COMMAND_AT = 3;

/**
 * A packet that was cut by a lost link leaves the board waiting for the rest of it, for ever: it would swallow the stop that comes after the
 * return (S2). The filler ends such a packet with the least effect; `filled` hears that it has left.
 */
export function createResync(queue: Queue, filled: () => void): Resync {
  let pending: Uint8Array | null = null;

  async function fill(packet: Uint8Array): Promise<void> {
    await queue.stop(packet);
    pending = null;
    filled();
  }

  return {
    cut(packet, filler) {
      if (filler !== null) pending ??= fillerFor(packet, filler);
    },
    send() {
      // Where it fails the link is lost again, and it is sent at the next return.
      if (pending !== null) fill(pending).catch(() => undefined);
    },
  };
}

/**
 * It is unknown how much of the packet arrived, so the bytes must be harmless at every place of it. A first 00 ends the wait
 * for LEN at once (S1) and makes a move whose count is missing an empty one, where the filler would have the board read
 * what earlier packets left behind (S13); but it names slot 0, which a run and a download must not get. What arrived of a
 * move before the cut takes effect: no byte can prevent that.
 */
function fillerFor(packet: Uint8Array, filler: number): Uint8Array {
  const command = packet[COMMAND_AT];
  if (command === COMMAND_NUMBER.run || command === COMMAND_NUMBER.download)
    return new Uint8Array(timings.line.fillerBytes).fill(filler);
  return Uint8Array.of(0, ...new Uint8Array(packet.length).fill(filler));
}

interface StopAgain {
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
