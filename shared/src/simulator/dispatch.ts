// What the open firmware does with a packet (S13-S21): the handlers read the mailbox's slot in place and never compare LEN
// with what they need. Which of them a build has is data of the build.

import { COMMAND_NUMBER } from '../codec/commands.ts';
import type { GroupStore } from './groupStore.ts';
import type { Runner } from './runner.ts';
import type { Servos } from './servos.ts';
import { readUint16, uint16 } from './storedFrame.ts';
import type { Work } from './work.ts';

/** How long each piece of the answer blocks the loop; empty for what takes no time. */
type Handler = () => Iterable<number>;
export type Handlers = ReadonlyMap<number, Handler>;
export type Reply = (command: number, params: readonly number[]) => Work;

export interface HandlerParts {
  readonly slot: Uint8Array;
  readonly servos: Servos;
  readonly runner: Runner;
  readonly reply: Reply;
  /** How long handing so many entries on to bus servos takes; no time where nothing is said. */
  readonly copyMs?: (entries: number) => number;
}

export interface StoreParts {
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
