// One question and its answer: encode, expect, send as a request, wait. The operations with a reply are built from
// this. Knows commands and reports; not what they mean for the robot.

import type { Clock } from '../clock.ts';
import type { Command } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import { wireMs } from '../codec/packet.ts';
import type { Report, ReportKind } from '../codec/reports.ts';
import { LinkError } from './linkError.ts';
import type { Queue } from './queue.ts';
import type { Replies } from './replies.ts';
import { encodeOrRefuse } from './rules.ts';
import { BABBLE_LIMIT } from './timings.ts';

export interface Exchange {
  /** Sends a command the board does not answer. */
  tell(command: Command): Promise<void>;
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
    async tell(command) {
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
