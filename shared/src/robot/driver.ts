// What a robot does with one kind of board: everything that depends on the family, put together. Another board makes another driver;
// the link, its queue and the snapshot stay.

import { COMMAND_NUMBER, type Command } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import { createBatteryReader } from './batteryReader.ts';
import { requireAtRest, type Core } from './core.ts';
import { createRobotEstimate } from './estimate.ts';
import { createExchange } from './exchange.ts';
import { createFirstMoves } from './firstMoves.ts';
import { createGroups, type Groups } from './groups.ts';
import type { LinkError } from './linkError.ts';
import { createLive, type Live } from './live.ts';
import { createMoveBuffer, servosIn } from './moveBuffer.ts';
import { sendRaw } from './raw.ts';
import { createReadings, type Readings } from './readings.ts';
import type { Replies } from './replies.ts';
import { encodeOrRefuse, releaseCommands } from './rules.ts';
import { noteCommand } from './store.ts';
import type { SlotMemory } from './storing.ts';

export interface DriverOptions extends Pick<Core, 'clock' | 'store' | 'queue'> {
  readonly replies: Replies;
  readonly slotMemory: SlotMemory | undefined;
  /** What the link carries, in bytes. */
  readonly longestPacket: number;
}

export interface Driver {
  readonly core: Core;
  readonly live: Live;
  readonly groups: Groups;
  readonly readings: Readings;
  readBattery(): Promise<number>;
  sendRaw(packet: Uint8Array): Promise<void>;
  release(servos: readonly number[]): Promise<void>;
  /** A command's last bit left the wire just now. */
  applied(command: Command): void;
  /** The newest move, or null when there is nothing to say. */
  takeMove(): Uint8Array | null;
  /** Ends what is under way here. What the board was asked and did not answer stays unknown. */
  drop(error: LinkError): void;
}

export function createDriver(family: Family, options: DriverOptions): Driver {
  const { clock, store, queue, replies, slotMemory, longestPacket } = options;
  const estimate = createRobotEstimate(family, clock);
  const servosPerMove = Math.min(family.servosPerMove, servosIn(longestPacket));
  const core: Core = {
    ...{ family, clock, store, estimate, queue, servosPerMove },
    exchange: createExchange(family, clock, queue, replies),
    isUnsettled: () => moves.servos().length > 0 || groups.isStopping() || isMotion(queue.unfinished()),
  };
  const moves = createMoveBuffer(family, servosPerMove);
  const firstMoves = createFirstMoves({ clock, isUnknown: estimate.isUnknown, due: queue.wake, waiting });
  const live = createLive(core, moves, firstMoves);
  const groups = createGroups(core, slotMemory);
  const readBattery = createBatteryReader(core);

  function waiting(waitingToStart: readonly number[]): void {
    if (!sameList(waitingToStart, store.state.waitingToStart)) store.update({ waitingToStart });
  }

  /** At rest only: a move that goes on or still waits for the wire would power the servos again (X7). */
  async function release(servos: readonly number[]): Promise<void> {
    requireAtRest(core);
    for (const command of releaseCommands(servos, servosPerMove, family)) await core.exchange.tell(command);
  }

  return {
    core,
    live,
    groups,
    readings: createReadings(core),
    readBattery,
    release,
    sendRaw: (packet) =>
      sendRaw(packet, store.state, estimate, {
        ...{ run: groups.run, stop: groups.stop, release, readBattery, send: queue.request },
        overtake: moves.drop,
      }),
    applied(command) {
      estimate.applied(command);
      noteCommand(store, command);
    },
    takeMove() {
      const servos = firstMoves.next(moves.servos());
      if (servos.length === 0) return null;
      const { move, swift } = moves.take(servos);
      return encodeOrRefuse(estimate.softened(move, swift), family);
    },
    drop(error) {
      live.drop();
      waiting([]);
      groups.drop();
      queue.purge(error);
      replies.fail(error);
      store.update({ activity: { kind: 'idle' } });
    },
  };
}

function sameList(one: readonly number[], other: readonly number[]): boolean {
  return one.length === other.length && one.every((servo, index) => servo === other[index]);
}

function isMotion(packet: Uint8Array | null): boolean {
  const command = packet?.[3];
  return command === COMMAND_NUMBER.move || command === COMMAND_NUMBER.run;
}
