// What a robot does with one kind of board: everything that depends on the family, put together. Another board makes another driver;
// the link, its queue and the snapshot stay.

import { COMMAND_NUMBER, type Command } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import { servosIn } from '../codec/packet.ts';
import { createBatteryReader, createReadings, type Readings } from './readings.ts';
import { requireAtRest, type Core } from './core.ts';
import { createRobotEstimate } from './estimate.ts';
import { createExchange, type Replies } from './replies.ts';
import { createGroups, type Groups } from './groups.ts';
import type { LinkError } from './linkError.ts';
import { createMoves, type Moves } from './moveBuffer.ts';
import { createPlayer, type Player } from './playing.ts';
import { sendRaw } from './raw.ts';
import { releaseCommands } from './rules.ts';
import { noteCommand } from './store.ts';
import type { SlotMemory } from './download.ts';

export interface DriverOptions extends Pick<Core, 'clock' | 'store' | 'queue'> {
  readonly replies: Replies;
  readonly slotMemory: SlotMemory | undefined;
  /** What the link carries, in bytes. */
  readonly longestPacket: number;
}

export interface Driver {
  readonly core: Core;
  readonly moves: Moves;
  readonly player: Player;
  readonly groups: Groups;
  readonly readings: Readings;
  readBattery(): Promise<number>;
  sendRaw(packet: Uint8Array): Promise<void>;
  release(servos: readonly number[]): Promise<void>;
  /** Moves and frames that have not left; false where there were none. */
  dropMoves(): boolean;
  /** A command's last bit left the wire just now. */
  applied(command: Command): void;
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
  const moves = createMoves(core);
  const player = createPlayer(core, moves);
  const groups = createGroups(core, slotMemory);
  const readBattery = createBatteryReader(core);

  function dropMoves(): boolean {
    const wasWaiting = moves.servos().length > 0;
    moves.clear();
    return player.drop() || wasWaiting;
  }

  /** At rest only: a move that goes on or still waits for the wire would power the servos again (X7). */
  async function release(servos: readonly number[]): Promise<void> {
    requireAtRest(core);
    for (const command of releaseCommands(servos, servosPerMove, family)) await core.exchange.tell(command);
  }

  return {
    core,
    moves,
    player,
    dropMoves,
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
    drop(error) {
      dropMoves();
      groups.drop();
      queue.purge(error);
      replies.fail(error);
      store.update({ activity: { kind: 'idle' } });
    },
  };
}

function isMotion(packet: Uint8Array | null): boolean {
  const command = packet?.[3];
  return command === COMMAND_NUMBER.move || command === COMMAND_NUMBER.run;
}
