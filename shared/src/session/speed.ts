// Sets how fast the board plays its groups, until it is switched off (X3). Nobody acknowledges it, and it is never repeated by
// itself: it changes a group that runs (safety.md section 4, class C).

import { requireReleased, type Core } from './core.ts';

/** `slot` null for every group. */
export async function setSpeed(core: Core, slot: number | null, percent: number): Promise<void> {
  requireReleased(core);
  await core.exchange.tell({ kind: 'setSpeed', slot, percent });
}
