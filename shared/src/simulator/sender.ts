// What the board says, byte by byte onto its line, and what becomes of an acknowledgement on purpose. Knows packets and the
// line; not why something is said.

import { COMMAND_NUMBER } from '../codec/commands.ts';
import { packetBytes } from '../codec/packet.ts';
import { UNHARMED, type AckFate, type FaultPlan } from './faults.ts';
import type { Line } from './line.ts';
import type { Work } from './work.ts';

export interface Sender {
  readonly reply: (command: number, params: readonly number[]) => Work;
  /** Plain ASCII. */
  readonly print: (text: string) => Work;
}

/** Replies that say no more than "taken" (S18-S20), each with another one's number for a foreign one. */
const FOREIGN_ACK: ReadonlyMap<number, number> = new Map([
  [COMMAND_NUMBER.run, COMMAND_NUMBER.erase],
  [COMMAND_NUMBER.erase, COMMAND_NUMBER.download],
  [COMMAND_NUMBER.download, COMMAND_NUMBER.run],
]);

export function createSender(line: () => Line, plan: FaultPlan): Sender {
  /** Sent by busy-waiting: each byte blocks the loop for its time on the wire (S21). */
  function* transmit(bytes: Iterable<number>, fate: AckFate): Work {
    for (const byte of bytes) {
      yield line().byteMs;
      line().transmit(byte, fate);
    }
  }

  function* acknowledge(command: number, foreign: number): Work {
    const fate = plan.nextAck();
    if (fate.foreign) yield* transmit(packetBytes(foreign, []), UNHARMED);
    yield* transmit(packetBytes(command, []), fate);
    if (fate.doubled) yield* transmit(packetBytes(command, []), fate);
  }

  function reply(command: number, params: readonly number[]): Work {
    const foreign = params.length === 0 ? FOREIGN_ACK.get(command) : undefined;
    return foreign === undefined
      ? transmit(packetBytes(command, params), UNHARMED)
      : acknowledge(command, foreign);
  }

  return {
    reply,
    print: (text) =>
      transmit(
        Array.from(text, (letter) => letter.charCodeAt(0)),
        UNHARMED,
      ),
  };
}
