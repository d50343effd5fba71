// One question and its answer: encode, expect, send in the request lane, wait. The operations with a reply are built from
// this. Knows commands and reports; not what they mean for the robot.

import type { Command } from '../protocol/commands.ts';
import { encodeCommand, RangeRefusal } from '../protocol/encode.ts';
import type { Family } from '../protocol/families.ts';
import type { Report, ReportKind } from '../protocol/reports.ts';
import type { Lanes } from './lanes.ts';
import { LinkError } from './linkError.ts';
import type { Replies } from './replies.ts';

/** Like `encodeCommand`, with the refusal as a LinkError the page has words for. */
export function encodeOrRefuse(command: Command, family: Family): Uint8Array {
  if (!family.commands.includes(command.kind)) {
    throw new LinkError('notSupported', `${family.name} has no command "${command.kind}"`);
  }
  try {
    return encodeCommand(command, family);
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
}

export function createExchange(family: Family, lanes: Lanes, replies: Replies): Exchange {
  return {
    async tell(command) {
      await lanes.request(encodeOrRefuse(command, family));
    },
    async ask(command, answer, timeoutMs) {
      const packet = encodeOrRefuse(command, family);
      const expectation = replies.expect(answer);
      try {
        await lanes.request(packet);
        return await expectation.within(timeoutMs);
      } finally {
        expectation.cancel();
      }
    },
  };
}
