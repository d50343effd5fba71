// Matches what the board says to who is waiting for it, by report kind: never "the next packet is my answer". One waiter
// a kind; everything unmatched stays unsolicited. Knows no packets and no retries.

import type { Clock } from '../clock.ts';
import type { Report, ReportKind } from '../codec/reports.ts';
import { LinkError } from './linkError.ts';

export interface Expectation {
  /** Starts the time-out: call when the question has left the wire. Rejects with `noAnswer` or what `fail` was given. */
  within(timeoutMs: number): Promise<Report>;
  cancel(): void;
}

export interface Replies {
  /**
   * Throws `busy` while another waits for the same kind. Expect before asking: the answer may overtake the send. What
   * comes before `earliestMs` cannot be the answer and stays unsolicited: a doubled one of the question before.
   */
  expect(kind: ReportKind, earliestMs?: number): Expectation;
  /** True when somebody was waiting for it. */
  deliver(report: Report): boolean;
  fail(error: LinkError): void;
}

interface Waiter {
  readonly earliestMs: number;
  readonly settle: (outcome: Report | LinkError) => void;
}

export function createReplies(clock: Clock): Replies {
  const waiters = new Map<ReportKind, Waiter>();

  function expect(kind: ReportKind, earliestMs = 0): Expectation {
    if (waiters.has(kind)) throw new LinkError('busy', `already waiting for "${kind}"`);
    let settle: Waiter['settle'] = () => undefined;
    let cancelTimer = (): void => undefined;
    const waiter: Waiter = { earliestMs, settle: (outcome) => settle(outcome) };
    const end = (): void => {
      cancelTimer();
      if (waiters.get(kind) === waiter) waiters.delete(kind);
    };
    const promise = new Promise<Report>((resolve, reject) => {
      settle = (outcome) => {
        end();
        if (outcome instanceof LinkError) reject(outcome);
        else resolve(outcome);
      };
    });
    // A waiter may be failed before anybody awaits it.
    promise.catch(() => undefined);
    waiters.set(kind, waiter);
    return {
      within(timeoutMs) {
        if (waiters.get(kind) === waiter) {
          const late = new LinkError('noAnswer', `no "${kind}" within ${timeoutMs} ms`);
          cancelTimer = clock.after(timeoutMs, () => waiter.settle(late));
        }
        return promise;
      },
      cancel: end,
    };
  }

  return {
    expect,
    deliver(report) {
      const waiter = waiters.get(report.kind);
      if (waiter === undefined || clock.now() < waiter.earliestMs) return false;
      waiter.settle(report);
      return true;
    },
    fail: (error) => [...waiters.values()].forEach((waiter) => waiter.settle(error)),
  };
}
