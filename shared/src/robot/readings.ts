// Asks a board about itself: where its servos stand, its firmware, its trims. Knows when it may be asked; its answers are noted by
// store.ts, whoever asked.

import { wireMs } from '../codec/packet.ts';
import type { Core } from './core.ts';
import { portions, requireQuestion } from './rules.ts';
import { DETAIL_TIMEOUT_MS, POSITION_MARGIN_MS, POSITION_READ_MS } from './timings.ts';

export interface Readings {
  /** Some boards are asked for all servos at once, whichever are meant. The answer is in `state.reported`. */
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
