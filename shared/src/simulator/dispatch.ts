// What the board does with a packet (S13-S21): the handlers read the mailbox's slot in place and never compare LEN with
// what they need. The battery answer is that of the documented board; the open firmware has none (S17).

import { COMMAND_NUMBER } from '../protocol/commands.ts';
import type { GroupStore } from './groupStore.ts';
import type { Runner } from './runner.ts';
import type { Servos } from './servos.ts';
import { readUint16 } from './storedFrame.ts';
import type { Work } from './work.ts';

export interface DispatchParts {
  readonly slot: Uint8Array;
  readonly servos: Servos;
  readonly store: GroupStore;
  readonly runner: Runner;
  readonly batteryMv: () => number;
  readonly reply: (command: number, params: readonly number[]) => Work;
}

const COMMAND_AT = 3;
const PARAMS_AT = 4;
const MOVE_ENTRIES_AT = 7;
const FRAME_AT = 7;

/** How long each piece of the answer blocks the loop; empty for what takes no time. */
type Handler = () => Iterable<number>;
const AT_ONCE: Iterable<number> = [];

/** Gives the function that serves the packet in the slot. */
export function createDispatch({ slot, servos, store, runner, batteryMv, reply }: DispatchParts): () => Work {
  function parameter(index: number): number {
    return slot[PARAMS_AT + index] ?? 0;
  }

  /** A count larger than the data executes what earlier packets left behind (S13). */
  function move(): Iterable<number> {
    const durationMs = readUint16(slot, PARAMS_AT + 1);
    for (let entry = 0; entry < parameter(0); entry += 1) {
      const at = MOVE_ENTRIES_AT + entry * 3;
      servos.accept(slot[at] ?? 0, readUint16(slot, at + 1), durationMs);
    }
    return AT_ONCE;
  }

  /** Acknowledged before the group is looked up (S18). */
  function* run(): Work {
    const group = parameter(0);
    const times = readUint16(slot, PARAMS_AT + 1);
    yield* reply(COMMAND_NUMBER.run, []);
    runner.request(group, times);
  }

  function stop(): Iterable<number> {
    runner.stop();
    return AT_ONCE;
  }

  function* erase(): Work {
    yield* store.clearCounts();
    yield* reply(COMMAND_NUMBER.erase, []);
  }

  function* readBattery(): Work {
    const mv = batteryMv();
    yield* reply(COMMAND_NUMBER.readBattery, [mv & 0xff, mv >> 8]);
  }

  /** Always the whole stored width, stale bytes included (S15); acknowledged whatever came of it (S20). */
  function* download(): Work {
    const place = { slot: parameter(0), frameCount: parameter(1), frameIndex: parameter(2) };
    yield* store.saveFrame(place, () => slot.slice(FRAME_AT, FRAME_AT + store.frameBytes));
    yield* reply(COMMAND_NUMBER.download, []);
  }

  const handlers = new Map<number, Handler>([
    [COMMAND_NUMBER.move, move],
    [COMMAND_NUMBER.run, run],
    [COMMAND_NUMBER.stop, stop],
    [COMMAND_NUMBER.erase, erase],
    [COMMAND_NUMBER.readBattery, readBattery],
    [COMMAND_NUMBER.download, download],
  ]);

  return function* serve(): Work {
    yield* handlers.get(slot[COMMAND_AT] ?? 0)?.() ?? AT_ONCE;
  };
}
