// Moves LeArm's servos every 10 ms, whatever its loop is busy with. Sleeps while nothing moves. Counts time, knows no
// command.

import type { Source } from '../agenda.ts';
import type { Servos } from '../servos.ts';

export const LEARM_TICK_MS = 10;

export function createTicker(now: () => number, servos: Pick<Servos, 'moving' | 'tick'>): Source {
  let lastMs = -Infinity;
  let asleep = true;

  const gridAfter = (atMs: number) => (Math.floor(atMs / LEARM_TICK_MS) + 1) * LEARM_TICK_MS;

  function dueMs(): number {
    if (!servos.moving()) {
      asleep = true;
      return Infinity;
    }
    if (asleep) lastMs = now();
    asleep = false;
    return gridAfter(lastMs);
  }

  function fire(): void {
    lastMs = dueMs();
    servos.tick();
  }

  return { dueMs, fire };
}
