// Asks for the battery voltage and remembers how often the board stayed silent. Knows when it may ask; not what the
// figure means for a pack.

import type { Core } from './core.ts';
import { LinkError } from './linkError.ts';
import { requireLine } from './rules.ts';
import { BATTERY_SILENT_LIMIT, BATTERY_TIMEOUT_MS } from './timings.ts';

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
