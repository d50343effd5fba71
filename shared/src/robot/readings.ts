// Asks a board about itself: its battery, where its servos stand, its firmware, its trims. Knows when it may be asked; its answers are
// noted by store.ts, whichever question they answer.

import { wireMs } from '../codec/packet.ts';
import type { Core } from './core.ts';
import { portions, requireQuestion, requireLine } from './rules.ts';
import {
  DETAIL_TIMEOUT_MS,
  POSITION_MARGIN_MS,
  POSITION_READ_MS,
  BATTERY_SILENT_LIMIT,
  BATTERY_TIMEOUT_MS,
} from './timings.ts';
import { LinkError } from './linkError.ts';

export interface Readings {
  /** Some boards are asked for all servos at once, whichever are listed. The answer is in `state.reported`. */
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

/** From the question's last bit: the board asks its servos one by one, then the answer needs its time on the wire. */
function positionsTimeoutMs(servoCount: number): number {
  return Math.ceil(POSITION_READ_MS * servoCount + wireMs(5 + 3 * servoCount)) + POSITION_MARGIN_MS;
}

/** Returns the read operation: resolves with millivolts. Calls while one is under way share its answer. */
export function createBatteryReader(core: Core): () => Promise<number> {
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
      return batteryMv;
    } catch (error) {
      if (error instanceof LinkError && error.code === 'noAnswer') countSilence();
      throw error;
    }
  }

  function countSilence(): void {
    const { battery } = core.store.state;
    // Where every such board answers, silence says that the board is gone, not that it cannot tell.
    if (core.family.certainAnswers.includes('readBattery')) return;
    silences += 1;
    if (silences < BATTERY_SILENT_LIMIT || battery.kind === 'silent') return;
    core.store.update({
      battery: { kind: 'silent', lastMv: battery.kind === 'read' ? battery.batteryMv : null },
    });
  }

  return () => (underWay ??= read().finally(() => (underWay = null)));
}
