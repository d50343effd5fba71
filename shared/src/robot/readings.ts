// What a board says of itself when it is asked: where its servos stand, its firmware, its trims. Knows when it may be asked;
// what it says is kept whoever asked, with the time.

import type { Command } from '../codec/commands.ts';
import { wireMs } from '../codec/packet.ts';
import type { Report } from '../codec/reports.ts';
import { requireQuestion, type Core } from './core.ts';
import { portions } from './portions.ts';
import type { Reading } from './state.ts';
import { DETAIL_TIMEOUT_MS, POSITION_MARGIN_MS, POSITION_READ_MS } from './timings.ts';

export interface Readings {
  /** Some boards are asked for all servos at once, whichever are meant. The answer is in `state.reported`. */
  readPositions(servos: readonly number[]): Promise<void>;
  readVersion(): Promise<void>;
  readOffsets(): Promise<void>;
  heard(report: Report): void;
  /** A command's last bit left the wire just now. */
  applied(command: Command): void;
}

export function createReadings(core: Core): Readings {
  const { family, clock, store, exchange, commands } = core;

  async function readPositions(servos: readonly number[]): Promise<void> {
    requireQuestion(core);
    if (commands !== undefined) {
      await commands.read('positions', servos);
      return;
    }
    if (family.commands.includes('readAllPositions')) {
      await exchange.ask({ kind: 'readAllPositions' }, 'allPositions', DETAIL_TIMEOUT_MS);
      return;
    }
    for (const some of portions(servos, core.servosPerMove)) {
      const command = { kind: 'readPositions', servos: some } as const;
      await exchange.ask(command, 'positions', positionsTimeoutMs(some.length));
    }
  }

  function keep(readings: readonly (readonly [servo: number, reading: Reading])[]): void {
    store.update({ reported: { ...store.state.reported, ...Object.fromEntries(readings) } });
  }

  return {
    readPositions,
    async readVersion() {
      requireQuestion(core);
      await (commands?.read('version') ??
        exchange.ask({ kind: 'readVersion' }, 'version', DETAIL_TIMEOUT_MS));
    },
    async readOffsets() {
      requireQuestion(core);
      await (commands?.read('offsets') ??
        exchange.ask({ kind: 'readOffsets' }, 'offsets', DETAIL_TIMEOUT_MS));
    },
    heard(report) {
      if (report.kind === 'version') store.update({ version: report.version });
      if (report.kind === 'offsets') store.update({ offsets: report.offsets });
      if (report.kind !== 'positions' && report.kind !== 'allPositions') return;
      const atMs = clock.now();
      keep(report.positions.map(({ servo, position }) => [servo, { position, atMs }]));
    },
    applied(command) {
      if (command.kind !== 'release') return;
      // It drops: what was said of it is no longer so.
      const held = Object.entries(store.state.reported).filter(
        ([servo]) => !command.servos.includes(Number(servo)),
      );
      store.update({ reported: Object.fromEntries(held) });
    },
  };
}

/** From the question's last bit: the board asks its servos one by one, then the answer needs its time on the wire. */
function positionsTimeoutMs(servoCount: number): number {
  return Math.ceil(POSITION_READ_MS * servoCount + wireMs(5 + 3 * servoCount)) + POSITION_MARGIN_MS;
}
