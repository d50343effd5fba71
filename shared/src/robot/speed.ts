// Sets how fast the board plays its groups, until it is switched off (X3). Nobody acknowledges it, and it is never repeated by
// itself: it changes a group that runs (safety.md section 4, class C).

import { requireReleased, type Core } from './core.ts';
import { refuseUnfit } from './exchange.ts';

/** `slot` null for every group. */
export async function setSpeed(core: Core, slot: number | null, percent: number): Promise<void> {
  requireReleased(core);
  const command = { kind: 'setSpeed', slot, percent } as const;
  refuseUnfit(command, core.family);
  await (core.commands?.setSpeed(slot, percent) ?? core.exchange.tell(command));
}
