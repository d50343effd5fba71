// When a lost link is tried again: by itself with growing pauses, sooner when the device shows up, or only when a person says
// so. The one place that begins an attempt unasked, so its switch holds for every such path. Knows no link and no transport.

import type { Clock } from '../clock.ts';
import { RECONNECT_DELAYS_MS } from './timings.ts';

export interface ReconnectOptions {
  readonly clock: Clock;
  attempt(): void;
  /** Calls `notify` when the device may be back; returns the function that ends it. */
  watch(notify: () => void): (() => void) | undefined;
  /** An attempt was planned or called off by the switch. */
  planned(retryAtMs: number | null): void;
}

export interface Reconnect {
  /** Waits for the next attempt; returns when it comes. `byTime` false: only when the device shows up, or a person asks. */
  plan(byTime: boolean): number | null;
  /** Ends the waiting. */
  rest(): void;
  /** The link is up, or a person begins anew: the next pause is the short one again. */
  refresh(): void;
  setEnabled(enabled: boolean): void;
}

export function createReconnect({ clock, attempt, watch, planned }: ReconnectOptions): Reconnect {
  let enabled = true;
  let attempts = 0;
  let waiting: { readonly byTime: boolean } | null = null;
  let stopWaiting = (): void => undefined;

  function rest(): void {
    waiting = null;
    stopWaiting();
    stopWaiting = () => undefined;
  }

  function go(): void {
    rest();
    attempt();
  }

  function plan(byTime: boolean): number | null {
    rest();
    waiting = { byTime };
    if (!enabled) return null;
    const delayMs = byTime ? nextDelayMs() : null;
    const cancelTimer = delayMs === null ? undefined : clock.after(delayMs, go);
    const cancelWatch = watch(go);
    stopWaiting = () => {
      cancelTimer?.();
      cancelWatch?.();
    };
    return delayMs === null ? null : clock.now() + delayMs;
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
    setEnabled(next) {
      if (next === enabled) return;
      enabled = next;
      attempts = 0;
      if (waiting !== null) planned(plan(waiting.byTime));
    },
  };
}
