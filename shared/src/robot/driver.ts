// What a session does with one kind of board: everything that depends on the family, put together. Another board makes
// another driver; the line, its queues and the snapshot stay. Knows no transport by name.

import { COMMAND_NUMBER, type Command } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import { createBatteryReader } from './batteryReader.ts';
import type { Core } from './core.ts';
import { createExchange, encodeOrRefuse } from './exchange.ts';
import { createGroups, type Groups } from './groups.ts';
import { createLive, type Live } from './live.ts';
import type { LinkError } from './linkError.ts';
import { createMoveBuffer, servosIn } from './moveBuffer.ts';
import { createRaw } from './raw.ts';
import { createReadings, type Readings } from './readings.ts';
import { release } from './release.ts';
import type { Replies } from './replies.ts';
import { createRobotEstimate } from './estimate.ts';
import type { SlotMemory } from './slotMemory.ts';
import { setSpeed } from './speed.ts';
import type { Transport } from './transport.ts';
import { createTurns } from './firstMoves.ts';

export interface DriverOptions extends Pick<Core, 'clock' | 'store' | 'lanes'> {
  readonly replies: Replies;
  readonly slotMemory: SlotMemory | undefined;
  /** What a shared link does itself. */
  readonly shared: Pick<
    Transport,
    'longestPacket' | 'slots' | 'moves' | 'player' | 'commands' | 'readBattery'
  >;
}

export interface Driver {
  readonly core: Core;
  readonly live: Live;
  readonly groups: Groups;
  readonly readings: Readings;
  readBattery(): Promise<number>;
  sendRaw(packet: Uint8Array): Promise<void>;
  setSpeed(slot: number | null, percent: number): Promise<void>;
  release(servos: readonly number[]): Promise<void>;
  /** A command's last bit left the wire just now. */
  applied(command: Command): void;
  /** The newest move, or null when there is nothing to say. */
  takeMove(): Uint8Array | null;
  /** Ends what is under way here. What the board was asked and did not answer stays unknown. */
  drop(error: LinkError): void;
}

export function createDriver(family: Family, options: DriverOptions): Driver {
  const { clock, store, lanes, replies, slotMemory, shared } = options;
  const robot = createRobotEstimate(family, clock);
  const servosPerMove = Math.min(family.servosPerMove, servosIn(shared.longestPacket));
  const core: Core = {
    ...{ family, clock, store, robot, lanes, servosPerMove, commands: shared.commands },
    exchange: createExchange(family, clock, lanes, replies),
    unsettled: () => moves.servos().length > 0 || groups.isStopping() || isMotion(lanes.unfinished()),
  };
  const buffer = createMoveBuffer(family, servosPerMove);
  const moves = shared.moves ?? buffer;
  const turns = createTurns({ clock, isUnknown: robot.isUnknown, due: lanes.wake, waiting });
  const live = createLive(core, moves, turns, shared.player);
  const groups = createGroups(core, slotMemory, shared.slots);
  const readBattery = createBatteryReader(core, shared.readBattery);
  const readings = createReadings(core);
  const releaseServos = (servos: readonly number[]): Promise<void> => release(core, servos);

  function waiting(waitingToStart: readonly number[]): void {
    if (!sameList(waitingToStart, store.state.waitingToStart)) store.update({ waitingToStart });
  }

  return {
    core,
    live,
    groups,
    readings,
    readBattery,
    setSpeed: (slot, percent) => setSpeed(core, slot, percent),
    release: releaseServos,
    sendRaw: createRaw(core, { run: groups.run, stop: groups.stop, release: releaseServos, readBattery }),
    applied(command) {
      robot.applied(command);
      readings.applied(command);
    },
    takeMove() {
      const servos = turns.next(buffer.servos());
      if (servos.length === 0) return null;
      const { move, swift } = buffer.take(servos);
      return encodeOrRefuse(robot.softened(move, swift), family);
    },
    drop(error) {
      live.drop();
      waiting([]);
      const activity = groups.drop();
      lanes.purge(error);
      replies.fail(error);
      store.update({ activity });
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
