// One link's life: opening, ready, lost, and back again by itself with growing pauses. Knows a transport and the clock;
// nothing of packets. Every failure leaves here as a LinkError.

import type { Clock } from '../clock.ts';
import { LinkError, type LinkErrorCode } from './linkError.ts';
import type { LinkState } from './state.ts';
import { RECONNECT_DELAYS_MS } from './timings.ts';
import type { Transport, TransportEvents } from './transport.ts';

export interface LinkOptions {
  readonly transport: Transport;
  readonly clock: Clock;
  changed(state: LinkState): void;
  /** The link is back after a loss: ready again. */
  returned(): void;
  received: TransportEvents['received'];
  latched(latched: boolean): void;
}

export interface Link {
  readonly state: LinkState;
  open(): Promise<void>;
  close(): Promise<void>;
  retryNow(): void;
  send(packet: Uint8Array): Promise<void>;
}

/** Failures that pass by themselves; the others need the person. */
const PASSING: readonly LinkErrorCode[] = ['lost', 'portMissing', 'portBusy', 'gatewayUnreachable'];

export function createLink({ transport, clock, changed, returned, received, latched }: LinkOptions): Link {
  let state: LinkState = { status: 'closed' };
  let attempts = 0;
  let hadBeenReady = false;
  let stopWaiting = (): void => undefined;
  /** Counts connections, so that a late word of an old one is not taken for the new one's. */
  let generation = 0;

  const isReady = (connection: number): boolean => state.status === 'ready' && connection === generation;

  function enter(next: LinkState): void {
    state = next;
    changed(next);
  }

  function fail(error: LinkError): void {
    const delayMs = PASSING.includes(error.code) ? nextDelayMs() : null;
    const cancelTimer = delayMs === null ? undefined : clock.after(delayMs, retry);
    const cancelWatch = transport.whenAvailable?.(retry);
    stopWaiting = () => {
      cancelTimer?.();
      cancelWatch?.();
    };
    enter({ status: 'lost', error, retryAtMs: delayMs === null ? null : clock.now() + delayMs });
  }

  function nextDelayMs(): number {
    const index = Math.min(attempts, RECONNECT_DELAYS_MS.length - 1);
    attempts += 1;
    return RECONNECT_DELAYS_MS[index] ?? 0;
  }

  function retry(): void {
    stopWaiting();
    // The failure is in the state; there is no caller to tell.
    connect().catch(() => undefined);
  }

  async function connect(): Promise<void> {
    const mine = (generation += 1);
    if (state.status !== 'lost') enter({ status: 'opening' });
    try {
      await transport.open({
        received: (bytes, whole) => mine === generation && received(bytes, whole),
        latched: (value) => mine === generation && latched(value),
        lost: (error) => mine === generation && fail(error),
      });
    } catch (error) {
      const reason =
        error instanceof LinkError ? error : new LinkError('internal', String(error), { cause: error });
      if (mine === generation) fail(reason);
      throw reason;
    }
    if (mine !== generation) return;
    attempts = 0;
    enter({ status: 'ready' });
    if (hadBeenReady) returned();
    hadBeenReady = true;
  }

  return {
    get state() {
      return state;
    },
    open() {
      stopWaiting();
      attempts = 0;
      return connect();
    },
    async close() {
      stopWaiting();
      generation += 1;
      hadBeenReady = false;
      if (state.status !== 'closed') enter({ status: 'closed' });
      await transport.close();
    },
    retryNow() {
      if (state.status === 'lost') retry();
    },
    async send(packet) {
      const mine = generation;
      if (!isReady(mine)) throw new LinkError('closed', 'the link is not open');
      await transport.send(packet);
      // A transport may count the wire's time without looking at the cable.
      if (!isReady(mine)) throw new LinkError('lost', 'the link went while the packet left');
    },
  };
}
