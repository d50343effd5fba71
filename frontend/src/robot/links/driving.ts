// Driving the gateway's robot: the lease of this page, whose nonce shows that an intent is of now, and its moves, which the gateway merges
// and paces. Values that change faster than messages are sent go together. Needs no timer, which a browser would slow down; knows no socket.

import { sleep, type Clock } from '#shared/clock.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import type { ClientMessage, LeaseState } from '#shared/client/messages.generated.ts';
import { isWatching, notDriving, type Lease, type Unattended } from '#shared/robot/lease.ts';

export interface Driving {
  readonly lease: Lease | null;
  /** Of the latest tick. */
  readonly nonce: string | null;
  leaseChanged(state: LeaseState): void;
  /** How many are at the gateway, this page among them, and what runs without a driver. */
  counted(clients: number, unattended: Unattended | null): void;
  ticked(nonce: string): void;
  /** Resolves when this page drives and its nonce is of now, no older than `withinMs`; rejects where another client drives. */
  begin(withinMs?: number): Promise<void>;
  /** Ends the waiting, with this error. */
  fail(error: LinkError): void;
  /** The gateway is not there any more: what it said is void. */
  gone(): void;
}

interface Waiter {
  readonly resolve: () => void;
  readonly reject: (error: LinkError) => void;
}

/**
 * Ticks come every 250 ms; one that is late waits behind what this page was busy with, and with the one before it the gateway would
 * refuse what is said now for its age.
 */
const FRESH_MS = 300;

/** Requests the lease where it is free, and answers each tick. */
export function createDriving(post: (message: ClientMessage) => void, now: () => number): Driving {
  let lease: Lease | null = null;
  let seen: Pick<Lease, 'others' | 'unattended'> = { others: 0, unattended: null };
  let nonce: string | null = null;
  let tickedMs = -Infinity;
  let waiters: readonly Waiter[] = [];

  function settle(each: (waiter: Waiter) => void): void {
    const current = waiters;
    waiters = [];
    current.forEach(each);
  }

  const fail = (error: LinkError): void => settle(({ reject }) => reject(error));

  return {
    get lease() {
      return lease;
    },
    get nonce() {
      return nonce;
    },
    leaseChanged(state) {
      lease = { ...state, ...seen };
      const wasOurs = nonce !== null;
      if (!state.drives) nonce = null;
      if (isWatching(lease)) fail(notDriving(lease));
      // No tick of it will come any more.
      else if (wasOurs && !state.drives) fail(new LinkError('expired', 'this page’s lease was over'));
    },
    counted(clients, unattended) {
      seen = { others: clients - 1, unattended };
      lease &&= { ...lease, ...seen };
    },
    ticked(next) {
      nonce = next;
      tickedMs = now();
      post({ type: 'heartbeat', nonce });
      settle(({ resolve }) => resolve());
    },
    begin(withinMs = FRESH_MS) {
      if (nonce !== null && now() - tickedMs <= withinMs) return Promise.resolve();
      if (isWatching(lease)) return Promise.reject(notDriving(lease));
      return new Promise((resolve, reject) => {
        if (nonce === null) post({ type: 'lease', action: 'request' });
        waiters = [...waiters, { resolve, reject }];
      });
    },
    fail,
    gone() {
      lease = null;
      nonce = null;
    },
  };
}

/** Below the gateway's rate (web/clients.py). What waits here is that much older when the wire is free. */
export const HAND_OVER_MS = 8;

export interface GatewayMoves {
  /** Newest wins per servo. `durationMs` 0: as fast as the link allows. */
  put(targets: readonly ServoTarget[], durationMs: number): void;
  /** With a value that was not handed over yet. */
  servos(): readonly number[];
  /** Of these servos nothing is handed over that was not yet. */
  drop(servos: readonly number[]): void;
  /** What was not handed over is not any more, and nothing is reported of the rest. */
  clear(): void;
  /** That message was refused. */
  refused(id: number, error: LinkError): void;
}

export interface GatewayMovesOptions {
  readonly clock: Clock;
  /** Gives the nonce of this page's lease. */
  begin(): Promise<string>;
  nextId(): number;
  post(message: ClientMessage): void;
  /** Something did not leave. */
  failed(error: LinkError): void;
}

export function createGatewayMoves({
  clock,
  begin,
  nextId,
  post,
  failed,
}: GatewayMovesOptions): GatewayMoves {
  const waiting = new Map<number, { readonly target: ServoTarget; readonly durationMs: number }>();
  let isHandingOver = false;
  let lastId = 0;
  /** The outcome of these and those before is not reported any more. */
  let forgottenId = 0;

  async function handOver(): Promise<void> {
    isHandingOver = true;
    try {
      while (waiting.size > 0) {
        say(await begin());
        await sleep(clock, HAND_OVER_MS);
      }
    } catch (error) {
      waiting.clear();
      failed(error instanceof LinkError ? error : new LinkError('internal', String(error), { cause: error }));
    } finally {
      isHandingOver = false;
    }
  }

  /** Those of one time together. */
  function say(nonce: string): void {
    const values = [...waiting.values()];
    waiting.clear();
    for (const durationMs of new Set(values.map((value) => value.durationMs))) {
      const targets = values.filter((value) => value.durationMs === durationMs).map(({ target }) => target);
      lastId = nextId();
      post({ type: 'move', id: lastId, targets, durationMs, nonce });
    }
  }

  function forget(): void {
    forgottenId = lastId;
  }

  return {
    put(targets, durationMs) {
      for (const { servo, position } of targets) {
        waiting.set(servo, { target: { servo, position }, durationMs });
      }
      if (!isHandingOver) void handOver();
    },
    servos: () => [...waiting.keys()],
    drop: (servos) => servos.forEach((servo) => waiting.delete(servo)),
    clear() {
      waiting.clear();
      forget();
    },
    refused(id, error) {
      if (id <= forgottenId) return;
      // One hand's values are refused for one reason: said once.
      forget();
      failed(error);
    },
  };
}
