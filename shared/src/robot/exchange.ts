// One question and its answer: encode, expect, send in the request lane, wait. The operations with a reply are built from
// this. Knows commands and reports; not what they mean for the robot.

import type { Clock } from '../clock.ts';
import type { Command } from '../codec/commands.ts';
import { encodeCommand, RangeRefusal } from '../codec/encode.ts';
import type { Family } from '../codec/families.ts';
import { checkCommand } from '../codec/limits.ts';
import { wireMs } from '../codec/packet.ts';
import type { Report, ReportKind } from '../codec/reports.ts';
import type { Lanes } from './queue.ts';
import { LinkError } from './linkError.ts';
import type { Replies } from './replies.ts';
import { BABBLE_LIMIT } from './timings.ts';

/** Like `encodeCommand`, with the refusal as a LinkError the page has words for. */
export const encodeOrRefuse = (command: Command, family: Family): Uint8Array =>
  orRefuse(encodeCommand, command, family);

/** The same refusal, of what is encoded later. */
export const refuseUnfit = (command: Command, family: Family): void =>
  orRefuse(checkCommand, command, family);

function orRefuse<T>(work: (command: Command, family: Family) => T, command: Command, family: Family): T {
  if (!family.commands.includes(command.kind)) {
    throw new LinkError('notSupported', `${family.name} has no command "${command.kind}"`);
  }
  try {
    return work(command, family);
  } catch (error) {
    if (error instanceof RangeRefusal) throw new LinkError('outOfRange', error.message, { cause: error });
    throw error;
  }
}

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

export function createExchange(family: Family, clock: Clock, lanes: Lanes, replies: Replies): Exchange {
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
      await lanes.request(encodeOrRefuse(command, family));
    },
    async ask(command, answer, timeoutMs) {
      const packet = encodeOrRefuse(command, family);
      // No board answers what has not reached it yet: whatever the lanes do, the packet needs its time on the wire.
      const expectation = replies.expect(answer, clock.now() + wireMs(packet.length));
      try {
        await lanes.request(packet);
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
