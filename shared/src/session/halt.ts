// STOP: latch, drop what is queued, tell the board three times, hold the robot where it is estimated to be. Also keeps
// what is known of the stop's fate. Motion waits until a person resumes.

import { sleep, type Clock } from '../clock.ts';
import { requireReady, type Core } from './core.ts';
import { encodeOrRefuse } from './exchange.ts';
import { LinkError } from './linkError.ts';
import type { Latch } from './state.ts';
import { STOP_REPEATS_MS } from './timings.ts';
import type { Transport } from './transport.ts';

export interface Halt {
  halt(): Promise<void>;
  resume(): Promise<void>;
  /** Another screen stopped a shared link; how the robot was held there is not known here. */
  latchedElsewhere(): void;
  /** The link went: whoever brings it back must look before anything moves again. */
  latchedByLoss(): void;
  /** Another screen released a shared link. */
  released(): void;
  /** The link is back after a loss: end what may still run, wait for a person. */
  stopAfterReturn(): void;
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
  readonly transport: Transport;
  dropAll(error: LinkError): void;
  /** Books a packet that a shared link sends for us, as if it had left by our own lanes. */
  sentByOthers(packet: Uint8Array): void;
}

export function createHalt(core: Core, { transport, dropAll, sentByOthers }: HaltOptions): Halt {
  const { family, clock, store, robot, lanes } = core;
  const stopPacket = encodeOrRefuse({ kind: 'stop' }, family);

  function latch(value: Latch): void {
    store.update({ latch: value });
    dropAll(new LinkError('latched', 'stopped'));
  }

  function note(stop: Latch['stop']): void {
    const { latch: current } = store.state;
    if (current !== null && current.stop !== 'confirmed') store.update({ latch: { ...current, stop } });
  }

  function holdPacket(): Uint8Array | null {
    const hold = robot.hold();
    return hold && encodeOrRefuse(hold, family);
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
    await repeatStop(clock, async () => {
      await lanes.stop(stopPacket);
      if (holds++ === 0) await sendHold();
    });
    await sendHold();
  }

  async function haltSharedLink(): Promise<void> {
    const hold = holdPacket();
    const done = transport.halt?.(hold);
    sentByOthers(stopPacket);
    if (hold !== null) sentByOthers(hold);
    await done;
  }

  async function send(sequence: () => Promise<void>): Promise<void> {
    try {
      await sequence();
      note('sent');
    } catch (error) {
      note('failed');
      throw error;
    }
  }

  return {
    latchedElsewhere() {
      robot.forget();
      latch({ reason: 'elsewhere', stop: 'sent' });
    },
    latchedByLoss: () => latch({ reason: 'reconnected', stop: 'failed' }),
    async halt() {
      latch({ reason: 'pressed', stop: 'sending' });
      await send(transport.halt ? haltSharedLink : haltOwnLink);
    },
    async resume() {
      requireReady(core);
      await transport.resume?.();
      store.update({ latch: null });
    },
    released: () => store.update({ latch: null }),
    stopAfterReturn() {
      // Its failure is the latch's `failed`; there is no caller to tell.
      send(() => repeatStop(clock, () => lanes.stop(stopPacket))).catch(() => undefined);
    },
    confirmed: () => note('confirmed'),
  };
}
