// What a robot does with one kind of board: everything that depends on the family, put together, and the questions to the board: battery,
// positions, firmware, trims. Another board makes another driver; the link, its queue and the snapshot stay. Answers are noted by store.ts.

import { COMMAND_NUMBER, type Command } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import { servosIn, wireMs } from '../codec/packet.ts';
import { createBatteryGuard } from './batteryGuard.ts';
import { requireAtRest, type Core } from './core.ts';
import { createRobotEstimate } from './estimate.ts';
import { createExchange, type Replies } from './replies.ts';
import { createGroups, type Groups } from './groups.ts';
import { LinkError } from './linkError.ts';
import { createMoves, type Moves } from './moveBuffer.ts';
import { createPlayer, type Player } from './playing.ts';
import { sendRaw } from './raw.ts';
import { releaseCommands, portions, requireQuestion, requireLine } from './rules.ts';
import { noteCommand } from './store.ts';
import type { SlotMemory } from './download.ts';
import {
  DETAIL_TIMEOUT_MS,
  POSITION_MARGIN_MS,
  POSITION_READ_MS,
  BATTERY_SILENT_LIMIT,
  BATTERY_TIMEOUT_MS,
} from './timings.ts';

export interface DriverOptions extends Pick<Core, 'clock' | 'store' | 'queue' | 'endMotion' | 'insistOnEnd'> {
  readonly replies: Replies;
  readonly slotMemory: SlotMemory | undefined;
  /** What the link carries, in bytes. */
  readonly longestPacket: number;
  /** New runs are refused with the battery at or below; null: never. */
  alarmMv(): number | null;
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
  /** Ends what is under way here. Unanswered queries stay unknown. */
  drop(error: LinkError): void;
}

export function createDriver(family: Family, options: DriverOptions): Driver {
  const { clock, store, queue, endMotion, insistOnEnd, replies, slotMemory, longestPacket, alarmMv } =
    options;
  const estimate = createRobotEstimate(family, clock);
  const servosPerMove = Math.min(family.servosPerMove, servosIn(longestPacket));
  const core: Core = {
    ...{ family, clock, store, estimate, queue, servosPerMove, endMotion, insistOnEnd },
    exchange: createExchange(family, clock, queue, replies),
    isUnsettled: () => moves.servos().length > 0 || groups.isStopping() || isMotion(queue.unfinished()),
  };
  const moves = createMoves(core);
  const readBattery = createBatteryReader(core, (batteryMv) => guard.heard(batteryMv));
  const isAtRest = (): boolean =>
    store.state.activity.kind === 'idle' && !estimate.moving() && !core.isUnsettled();
  const guard = createBatteryGuard({ family, clock, store, alarmMv, isAtRest, readBattery });
  const player = createPlayer(core, moves, guard);
  const groups = createGroups(core, slotMemory, guard);

  function dropMoves(): boolean {
    const wasWaiting = moves.servos().length > 0 || estimate.partDueMs() < Infinity;
    moves.clear();
    return player.drop() || wasWaiting;
  }

  /** At rest only: a move that continues or still waits for the wire would power the servos again (X7). */
  async function release(servos: readonly number[]): Promise<void> {
    requireAtRest(core);
    for (const command of releaseCommands(servos, servosPerMove, family)) await core.exchange.send(command);
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

export interface Readings {
  /** Some boards are queried for all servos at once, whichever are listed. The answer is in `state.reported`. */
  readPositions(servos: readonly number[]): Promise<void>;
  readVersion(): Promise<void>;
  readOffsets(): Promise<void>;
}

export function createReadings(core: Core): Readings {
  const { family, store, exchange } = core;

  async function readPositions(servos: readonly number[]): Promise<void> {
    requireQuestion(store.state);
    if (family.commands.includes('readAllPositions')) {
      await exchange.ask({ kind: 'readAllPositions' }, 'allPositions', DETAIL_TIMEOUT_MS);
      return;
    }
    for (const some of portions(servos, core.servosPerMove)) {
      const command = { kind: 'readPositions', servos: some } as const;
      await exchange.ask(command, 'positions', positionsTimeoutMs(some.length));
    }
  }

  return {
    readPositions,
    async readVersion() {
      requireQuestion(store.state);
      await exchange.ask({ kind: 'readVersion' }, 'version', DETAIL_TIMEOUT_MS);
    },
    async readOffsets() {
      requireQuestion(store.state);
      await exchange.ask({ kind: 'readOffsets' }, 'offsets', DETAIL_TIMEOUT_MS);
    },
  };
}

/** From the query's last bit: the board queries its servos one by one, then the answer needs its time on the wire. */
function positionsTimeoutMs(servoCount: number): number {
  return Math.ceil(POSITION_READ_MS * servoCount + wireMs(5 + 3 * servoCount)) + POSITION_MARGIN_MS;
}

/** Returns the read operation: resolves with millivolts. Calls while one is under way share its answer. */
export function createBatteryReader(core: Core, heard: (batteryMv: number) => void): () => Promise<number> {
  let underWay: Promise<number> | null = null;
  let silences = 0;

  async function read(): Promise<number> {
    const { store, clock, exchange } = core;
    requireLine(store.state);
    try {
      const report = await exchange.ask({ kind: 'readBattery' }, 'battery', BATTERY_TIMEOUT_MS);
      const batteryMv = report.kind === 'battery' ? report.batteryMv : 0;
      silences = 0;
      store.update({ battery: { kind: 'read', batteryMv, atMs: clock.now() } });
      heard(batteryMv);
      return batteryMv;
    } catch (error) {
      if (error instanceof LinkError && error.code === 'noAnswer') countSilence();
      throw error;
    }
  }

  function countSilence(): void {
    const { battery } = core.store.state;
    // Where every such board answers, silence says that the board is gone, not that it has no battery report.
    if (core.family.certainAnswers.includes('readBattery')) return;
    silences += 1;
    if (silences < BATTERY_SILENT_LIMIT || battery.kind === 'silent') return;
    core.store.update({
      battery: { kind: 'silent', lastMv: battery.kind === 'read' ? battery.batteryMv : null },
    });
  }

  return () => (underWay ??= read().finally(() => (underWay = null)));
}
