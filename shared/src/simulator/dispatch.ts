// From bytes to what the open firmware does with a packet: its parser with its real weaknesses (S1-S5), and handlers that read
// the mailbox's slot in place and never compare LEN with what they need (S13-S21). Which handlers a build has is data of the build.

import { HEADER, MIN_LENGTH } from '../codec/packet.ts';
import { COMMAND_NUMBER } from '../codec/commands.ts';
import { type GroupStore, readUint16, uint16 } from './groupStore.ts';
import type { Runner } from './runner.ts';
import type { Servos } from './servos.ts';
import type { Work } from './agenda.ts';

// The board's byte parser, with its real weaknesses: it waits for ever, never resynchronises inside a packet and jams
// on LEN 254 and 255 (S1-S5).

const BUFFER_BYTES = 256;
const LENGTH_AT = 2;

/** `complete` gets a view of the parser's buffer, valid during the call: LEN + 2 bytes. */
export function createParser(complete: (packet: Uint8Array) => void): (byte: number) => void {
  const buffer = new Uint8Array(BUFFER_BYTES).fill(HEADER, 0, LENGTH_AT);
  let headersSeen = 0;
  let index = 0;
  let length = 0;

  function hunt(byte: number): void {
    headersSeen = byte === HEADER ? headersSeen + 1 : 0;
    index = LENGTH_AT;
  }

  return (byte) => {
    if (headersSeen < 2) {
      hunt(byte);
      return;
    }
    buffer[index] = byte;
    // Also after the 8-bit index has wrapped: LEN is taken again from whatever lands here (S3).
    if (index === LENGTH_AT) length = byte;
    if (index === LENGTH_AT && length < MIN_LENGTH) {
      headersSeen = 0;
      return;
    }
    index = (index + 1) % BUFFER_BYTES;
    if (index !== length + 2) return;
    headersSeen = 0;
    complete(buffer.subarray(0, index));
  };
}

/** How long each piece of the answer blocks the loop; empty for what takes no time. */
type Handler = () => Iterable<number>;
export type Handlers = ReadonlyMap<number, Handler>;
export type Reply = (command: number, params: readonly number[]) => Work;

interface HandlerParts {
  readonly slot: Uint8Array;
  readonly servos: Servos;
  readonly runner: Runner;
  readonly reply: Reply;
  /** How long handing so many entries on to bus servos takes; no time where nothing is said. */
  readonly copyMs?: (entries: number) => number;
}

interface StoreParts {
  readonly slot: Uint8Array;
  readonly store: GroupStore;
  readonly reply: Reply;
}

const COMMAND_AT = 3;
export const PARAMS_AT = 4;
const MOVE_ENTRIES_AT = 7;
const FRAME_AT = 7;
const AT_ONCE: Iterable<number> = [];

/** Move, run and stop, as every board has them. With `acksRun` a run is answered before the group is looked up (S18). */
export function motionHandlers(parts: HandlerParts, acksRun: boolean): Handlers {
  const { slot, servos, runner, reply, copyMs = () => 0 } = parts;

  /** A count larger than the data executes what earlier packets left behind (S13). */
  function* move(): Work {
    const durationMs = readUint16(slot, PARAMS_AT + 1);
    const count = slot[PARAMS_AT] ?? 0;
    for (let entry = 0; entry < count; entry += 1) {
      const at = MOVE_ENTRIES_AT + entry * 3;
      servos.accept(slot[at] ?? 0, readUint16(slot, at + 1), durationMs);
    }
    yield copyMs(count);
  }

  function* run(): Work {
    const group = slot[PARAMS_AT] ?? 0;
    const times = readUint16(slot, PARAMS_AT + 1);
    if (acksRun) yield* reply(COMMAND_NUMBER.run, []);
    yield* runner.request(group, times);
  }

  return new Map<number, Handler>([
    [COMMAND_NUMBER.move, move],
    [COMMAND_NUMBER.run, run],
    [COMMAND_NUMBER.stop, runner.stop],
  ]);
}

export function storeHandlers({ slot, store, reply }: StoreParts): Handlers {
  function* erase(): Work {
    yield* store.clearCounts();
    yield* reply(COMMAND_NUMBER.erase, []);
  }

  /** Always the whole stored width, stale bytes included (S15); acknowledged whatever came of it (S20). */
  function* download(): Work {
    const [group = 0, frameCount = 0, frameIndex = 0] = slot.slice(PARAMS_AT, FRAME_AT);
    const place = { slot: group, frameCount, frameIndex };
    yield* store.saveFrame(place, () => slot.slice(FRAME_AT, FRAME_AT + store.frameBytes));
    yield* reply(COMMAND_NUMBER.download, []);
  }

  return new Map<number, Handler>([
    [COMMAND_NUMBER.erase, erase],
    [COMMAND_NUMBER.download, download],
  ]);
}

export function batteryHandler(batteryMv: () => number, reply: Reply): Handlers {
  function* readBattery(): Work {
    yield* reply(COMMAND_NUMBER.readBattery, uint16(batteryMv()));
  }

  return new Map([[COMMAND_NUMBER.readBattery, readBattery]]);
}

/** Gives the function that serves the packet in the slot; what no handler knows is ignored (S5). */
export function createDispatch(slot: Uint8Array, ...known: readonly Handlers[]): () => Work {
  const handlers = new Map(known.flatMap((some) => [...some]));
  return function* serve(): Work {
    yield* handlers.get(slot[COMMAND_AT] ?? 0)?.() ?? AT_ONCE;
  };
}
