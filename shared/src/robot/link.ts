// A link's life, whatever it leads to: opening, open, lost and back again, when it is tried again included. Knows the clock; not what
// is opened. Every failure leaves here as a LinkError.

import type { Clock } from '../clock.ts';
import type { OpenOptions } from './byteChannel.ts';
import { asLinkError, LinkError, passesByItself } from './linkError.ts';
import type { LinkState } from './state.ts';
import { RECONNECT_DELAYS_MS } from './timings.ts';

/** What the line itself can be; who answers on it is decided above. */
export type LineState =
  | Extract<LinkState, { status: 'closed' | 'opening' | 'lost' | 'refused' }>
  | { readonly status: 'open'; readonly isReturn: boolean };

export interface LinkOptions {
  readonly clock: Clock;
  /** Resolves when the line is open. Called again after a failure, a loss or `close`. */
  open(options?: OpenOptions): Promise<void>;
  close(): Promise<void> | void;
  changed(state: LineState): void;
}

export interface Link {
  readonly isOpen: boolean;
  /** Counts attempts, so that a late event of an old one is not taken for the new one's. */
  readonly attempt: number;
  open(): Promise<void>;
  close(): Promise<void>;
  retryNow(): void;
  /** An attempt now, before which another tab lets go of the device. Rejects with `heldElsewhere` where it does not. */
  takeOver(): Promise<void>;
  setAutoReconnect(enabled: boolean): void;
  /** The open line ended by itself; or, between two attempts, the reason why it is down has changed. */
  lost(error: LinkError): void;
  /** Ends what is under way, an attempt too, as lost; a later one may follow. */
  abandon(error: LinkError): void;
  /** Worth an attempt before the next one is due. */
  available(): void;
  /** Throws where the line is not open. */
  requireOpen(): void;
}

export function createLink({ clock, open, close, changed }: LinkOptions): Link {
  let state: LineState = { status: 'closed' };
  let wasOpenBefore = false;
  let attempt = 0;
  let isTrying = false;

  const isDown = (): boolean => state.status === 'lost' || state.status === 'refused';

  const reconnect = createReconnect({
    clock,
    retry,
    planned(retryAtMs) {
      if (state.status === 'lost') enter({ ...state, retryAtMs });
    },
  });

  function enter(next: LineState): void {
    state = next;
    changed(next);
  }

  function fail(error: LinkError): void {
    isTrying = false;
    const passes = passesByItself(error);
    const retryAtMs = reconnect.plan(passes);
    enter(passes ? { status: 'lost', error, retryAtMs } : { status: 'refused', error });
  }

  function retry(): void {
    reconnect.rest();
    // The failure is in the state; no caller waits for it.
    connect().catch(() => undefined);
  }

  async function connect(options?: OpenOptions): Promise<void> {
    const mine = (attempt += 1);
    isTrying = true;
    if (!isDown()) enter({ status: 'opening' });
    try {
      await open(options);
    } catch (error) {
      const reason = asLinkError(error);
      if (mine === attempt) fail(reason);
      throw reason;
    }
    if (mine !== attempt) return;
    isTrying = false;
    reconnect.refresh();
    const isReturn = wasOpenBefore;
    wasOpenBefore = true;
    enter({ status: 'open', isReturn });
  }

  return {
    get isOpen() {
      return state.status === 'open';
    },
    get attempt() {
      return attempt;
    },
    open() {
      reconnect.rest();
      reconnect.refresh();
      return connect();
    },
    async close() {
      reconnect.rest();
      attempt += 1;
      isTrying = false;
      wasOpenBefore = false;
      if (state.status !== 'closed') enter({ status: 'closed' });
      await close();
    },
    retryNow() {
      if (isDown()) retry();
    },
    takeOver() {
      reconnect.rest();
      return connect({ takesOver: true });
    },
    setAutoReconnect: reconnect.setEnabled,
    lost(error) {
      const isNews = 'error' in state && !isTrying && !isSameReason(state.error, error);
      if (state.status === 'open' || isNews) fail(error);
    },
    abandon(error) {
      if (state.status === 'closed' || state.status === 'refused') return;
      attempt += 1;
      fail(error);
    },
    available: reconnect.available,
    requireOpen() {
      if (state.status === 'open') return;
      throw isDown()
        ? new LinkError('lost', 'the link is gone')
        : new LinkError('closed', 'the link is not open');
    },
  };
}

const isSameReason = (one: LinkError, other: LinkError): boolean =>
  one.code === other.code && one.heldBy.join() === other.heldBy.join();

interface ReconnectOptions {
  readonly clock: Clock;
  retry(): void;
  /** An attempt was planned or called off by the switch. */
  planned(retryAtMs: number | null): void;
}

interface Reconnect {
  /** Waits for the next attempt; returns when it comes. `byTime` false: only when the device shows up, or a person requests it. */
  plan(byTime: boolean): number | null;
  /** Ends the waiting. */
  rest(): void;
  /** The link is up, or a person begins anew: the next pause is the short one again. */
  refresh(): void;
  /** The device may be back. */
  available(): void;
  setEnabled(enabled: boolean): void;
}

/** The one place that begins an attempt without a person, so its switch holds for every such path. */
function createReconnect({ clock, retry, planned }: ReconnectOptions): Reconnect {
  let enabled = true;
  let attempts = 0;
  let waiting: { readonly byTime: boolean } | null = null;
  let cancelTimer = (): void => undefined;

  function rest(): void {
    waiting = null;
    cancelTimer();
    cancelTimer = () => undefined;
  }

  function plan(byTime: boolean): number | null {
    rest();
    waiting = { byTime };
    if (!enabled || !byTime) return null;
    const delayMs = nextDelayMs();
    cancelTimer = clock.after(delayMs, retry);
    return clock.now() + delayMs;
  }

  function nextDelayMs(): number {
    const delayMs = RECONNECT_DELAYS_MS[Math.min(attempts, RECONNECT_DELAYS_MS.length - 1)] ?? 0;
    attempts += 1;
    return delayMs;
  }

  return {
    plan,
    rest,
    refresh() {
      attempts = 0;
    },
    available() {
      if (enabled && waiting !== null) retry();
    },
    setEnabled(next) {
      if (next === enabled) return;
      enabled = next;
      attempts = 0;
      if (waiting !== null) planned(plan(waiting.byTime));
    },
  };
}
