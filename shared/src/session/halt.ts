// STOP: latch, drop what is queued, tell the board three times, hold the robot where it is estimated to be. Also keeps
// what is known of the stop's fate. Motion waits until a person resumes.

import { sleep, type Clock } from '../clock.ts';
import { encodeCommand } from '../protocol/encode.ts';
import { UNKNOWN_BOARD } from '../protocol/families.ts';
import { requireReady } from './core.ts';
import type { Lanes } from './lanes.ts';
import { LinkError } from './linkError.ts';
import type { Latch, Unheld } from './state.ts';
import type { SessionStore } from './store.ts';
import { STOP_REPEATS_MS } from './timings.ts';
import type { HaltReason, SharedLatchReason, Transport } from './transport.ts';

export interface Halt {
  halt(why?: HaltReason): Promise<void>;
  resume(): Promise<void>;
  /** Another screen stopped a shared link, `by` where a person did; what that sent is told apart. */
  latchedElsewhere(reason: SharedLatchReason, by: string | null): void;
  /** The link went: whoever brings it back must look before anything moves again. */
  latchedByLoss(): void;
  /** Another screen released a shared link. */
  released(): void;
  /** The link is back after a loss: end what may still run, wait for a person. */
  stopAfterReturn(): void;
  /** The board says that a group runs: behind a stop it is one that it kept while its flash worked, which drops stops (S9, S41). */
  runTold(): void;
  confirmed(): void;
}

/** Calls `send` now and at each repeat, counted from the first. */
export async function repeatStop(clock: Clock, send: () => Promise<void>): Promise<void> {
  const firstMs = clock.now();
  await send();
  for (const offsetMs of STOP_REPEATS_MS) {
    await sleep(clock, Math.max(0, firstMs + offsetMs - clock.now()));
    await send();
  }
}

export interface HaltOptions {
  readonly clock: Clock;
  readonly store: SessionStore;
  readonly lanes: Lanes;
  readonly transport: Transport;
  /** The move that freezes the robot where it is estimated to be, or null where nothing is known. */
  holdPacket(): Uint8Array | null;
  /** What it cannot freeze. */
  unheld(): Unheld;
  dropAll(error: LinkError): void;
  /** Books a packet that a shared link sends for us, as if it had left by our own lanes. */
  sentByOthers(packet: Uint8Array): void;
}

/** The same on every board, so also on one that nobody has identified. */
export const STOP_PACKET = encodeCommand({ kind: 'stop' }, UNKNOWN_BOARD);

export function createHalt(options: HaltOptions): Halt {
  const { clock, store, lanes, transport, holdPacket, dropAll, sentByOthers } = options;

  let underWay: Promise<void> = Promise.resolve();
  let stopsFollow = false;

  function latch(value: Latch): void {
    store.update({ latch: value });
    dropAll(new LinkError('latched', 'stopped'));
  }

  function note(stop: Latch['stop']): void {
    const { latch: current } = store.state;
    if (current !== null && current.stop !== 'confirmed') store.update({ latch: { ...current, stop } });
  }

  async function sendHold(): Promise<void> {
    const hold = holdPacket();
    if (hold !== null) await lanes.stop(hold);
  }

  /**
   * A stop never ends the move in progress (S50), so the first hold follows the first stop at once; the last one catches a
   * frame that began because that stop fell into a full mailbox (S52).
   */
  async function haltOwnLink(): Promise<void> {
    let holds = 0;
    stopsFollow = true;
    await repeatStop(clock, async () => {
      await lanes.stop(STOP_PACKET);
      if (holds++ === 0) await sendHold();
    }).finally(() => (stopsFollow = false));
    await sendHold();
  }

  async function haltSharedLink(why: HaltReason): Promise<void> {
    const hold = holdPacket();
    const done = transport.halt?.(hold, why);
    sentByOthers(STOP_PACKET);
    if (hold !== null) sentByOthers(hold);
    await done;
    // What was under way left before it, and its word came behind.
    if (hold !== null) sentByOthers(hold);
  }

  /** The frame that goes on in spite of the first press does so at the next one: the group itself has ended by then. */
  function unheldNow(): Unheld {
    return store.state.latch?.unheld === 'unknownGroup' ? 'unknownGroup' : options.unheld();
  }

  async function send(sequence: () => Promise<void>): Promise<void> {
    const sending = sequence();
    underWay = sending.catch(() => undefined);
    try {
      await sending;
      note('sent');
    } catch (error) {
      note('failed');
      throw error;
    }
  }

  return {
    latchedElsewhere(reason, by) {
      latch({ reason, by, stop: 'sent', unheld: [] });
    },
    latchedByLoss: () => latch({ reason: 'reconnected', by: null, stop: 'failed', unheld: [] }),
    async halt(why = 'pressed') {
      latch({ reason: why, by: null, stop: 'sending', unheld: unheldNow() });
      await send(transport.halt ? () => haltSharedLink(why) : haltOwnLink);
    },
    async resume() {
      requireReady(store);
      // Its last hold would take back what is moved meanwhile.
      await underWay;
      await transport.resume?.();
      store.update({ latch: null });
    },
    released: () => store.update({ latch: null }),
    stopAfterReturn() {
      // Its failure is the latch's `failed`; there is no caller to tell.
      send(() => repeatStop(clock, () => lanes.stop(STOP_PACKET))).catch(() => undefined);
    },
    runTold() {
      const { latch: current } = store.state;
      // A shared link has its own eye on it.
      if (current === null || stopsFollow || transport.halt !== undefined) return;
      store.update({ latch: { ...current, stop: 'sending' } });
      void underWay.then(() => send(haltOwnLink)).catch(() => undefined);
    },
    confirmed: () => note('confirmed'),
  };
}
