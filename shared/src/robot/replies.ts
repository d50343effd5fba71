// One question and its answer: encode, expect, send as a request, wait. An answer is matched by its kind: never "the next packet is my
// answer"; what nothing waits for stays unsolicited. Knows commands and reports; not what they mean for the robot.

import type { Clock } from '../clock.ts';
import type { Command } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import { wireMs } from '../codec/packet.ts';
import type { Report, ReportKind } from '../codec/reports.ts';
import { LinkError } from './linkError.ts';
import type { Queue } from './queue.ts';
import { encodeOrRefuse } from './rules.ts';
import { BABBLE_LIMIT } from './timings.ts';

export interface Exchange {
  /** Sends a command the board does not answer. */
  send(command: Command): Promise<void>;
  /** Sends a command and waits for its report. Rejects with `noAnswer` after `timeoutMs` from its last bit. */
  ask(command: Command, answer: ReportKind, timeoutMs: number): Promise<Report>;
  /** Resolves when no such report has come for `quietMs`. Rejects with `noAnswer` where they do not end. */
  silence(answer: ReportKind, quietMs: number): Promise<void>;
}

export function isNoAnswer(error: unknown): boolean {
  return error instanceof LinkError && error.code === 'noAnswer';
}

export function createExchange(family: Family, clock: Clock, queue: Queue, replies: Replies): Exchange {
  /** False when the time passed without one. */
  async function comes(answer: ReportKind, withinMs: number): Promise<boolean> {
    try {
      await replies.expect(answer).within(withinMs);
      return true;
    } catch (error) {
      if (isNoAnswer(error)) return false;
      throw error;
    }
  }

  return {
    async send(command) {
      await queue.request(encodeOrRefuse(command, family));
    },
    async ask(command, answer, timeoutMs) {
      const packet = encodeOrRefuse(command, family);
      // No board answers what has not reached it yet: however short the queue is, the packet needs its time on the wire.
      const expectation = replies.expect(answer, clock.now() + wireMs(packet.length));
      try {
        await queue.request(packet);
        return await expectation.within(timeoutMs);
      } finally {
        expectation.cancel();
      }
    },
    async silence(answer, quietMs) {
      for (let heard = 0; heard <= BABBLE_LIMIT; heard += 1) if (!(await comes(answer, quietMs))) return;
      throw new LinkError('noAnswer', `"${answer}" comes again and again without a question`);
    },
  };
}

interface Expectation {
  /** Starts the time-out: call when the question has left the wire. Rejects with `noAnswer` or what `fail` was given. */
  within(timeoutMs: number): Promise<Report>;
  cancel(): void;
}

/** One waiter a kind. */
export interface Replies {
  /**
   * Throws `busy` while another waits for the same kind. Call it before sending: the answer may overtake the send. What
   * comes before `earliestMs` cannot be the answer and stays unsolicited: a doubled one of the question before.
   */
  expect(kind: ReportKind, earliestMs?: number): Expectation;
  /** True when a request was waiting for it. */
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
    // A waiter may be failed before it is awaited.
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
