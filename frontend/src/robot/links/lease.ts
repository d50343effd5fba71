// The lease as the gateway gives it to this page: requests one that is free, answers each tick, and has the nonce that shows that
// an intent is of now. Knows no packet. It needs no timer, which a browser would slow down.

import { isWatching, notDriving, type Lease, type Unattended } from '#shared/robot/lease.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import type { ClientMessage, LeaseState } from './messages.generated.ts';

export interface Driving {
  readonly lease: Lease | null;
  /** Of the latest tick. */
  readonly nonce: string | null;
  leaseChanged(state: LeaseState): void;
  /** How many are at the gateway, this page among them, and what goes on without anybody. */
  counted(clients: number, unattended: Unattended | null): void;
  ticked(nonce: string): void;
  /** Resolves when this page drives and its nonce is of now, no older than `withinMs`; rejects where somebody else drives. */
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
