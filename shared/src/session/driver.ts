// What a session does with one kind of board: everything that depends on the family, put together. Another board makes
// another driver; the line, its queues and the snapshot stay. Knows no transport by name.

import { COMMAND_NUMBER } from '../protocol/commands.ts';
import type { Family } from '../protocol/families.ts';
import { createBatteryReader } from './batteryReader.ts';
import type { Core } from './core.ts';
import { createExchange, encodeOrRefuse } from './exchange.ts';
import { createGroups, type Groups } from './groups.ts';
import { createLive, type Live } from './live.ts';
import type { LinkError } from './linkError.ts';
import { createMoveBuffer } from './moveBuffer.ts';
import { createRaw } from './raw.ts';
import type { Replies } from './replies.ts';
import { createRobotEstimate } from './robot.ts';
import type { SlotMemory } from './slotMemory.ts';

export interface DriverOptions extends Pick<Core, 'clock' | 'store' | 'lanes'> {
  readonly replies: Replies;
  readonly slotMemory: SlotMemory | undefined;
}

export interface Driver {
  readonly core: Core;
  readonly live: Live;
  readonly groups: Groups;
  readBattery(): Promise<number>;
  sendRaw(packet: Uint8Array): Promise<void>;
  /** The newest move as a packet, or null when there is nothing to say. */
  takeMove(): Uint8Array | null;
  /** Ends what is under way here. What the board was asked and did not answer stays unknown. */
  drop(error: LinkError): void;
}

export function createDriver(family: Family, options: DriverOptions): Driver {
  const { clock, store, lanes, replies, slotMemory } = options;
  const robot = createRobotEstimate(family, clock);
  const core: Core = {
    ...{ family, clock, store, robot, lanes },
    exchange: createExchange(family, clock, lanes, replies),
    unsettled: () => !moves.isEmpty() || groups.isStopping() || isMotion(lanes.unfinished()),
  };
  const moves = createMoveBuffer(family);
  const live = createLive(core, moves);
  const groups = createGroups(core, slotMemory);
  const readBattery = createBatteryReader(core);

  return {
    core,
    live,
    groups,
    readBattery,
    sendRaw: createRaw(core, { run: groups.run, stop: groups.stop, readBattery }),
    takeMove() {
      const move = moves.take();
      return move && encodeOrRefuse(robot.softened(move), family);
    },
    drop(error) {
      live.drop();
      groups.drop();
      lanes.purge(error);
      replies.fail(error);
      store.update({ activity: { kind: 'idle' } });
    },
  };
}

function isMotion(packet: Uint8Array | null): boolean {
  const command = packet?.[3];
  return command === COMMAND_NUMBER.move || command === COMMAND_NUMBER.run;
}
