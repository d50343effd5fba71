// Takes the torque off servos: what they carry drops, and hands can pose them. Knows when that may be done; that a person has
// been warned is the page's affair.

import { requireRest, type Core } from './core.ts';
import { encodeOrRefuse } from './exchange.ts';

/** `clearMoves` drops what still waits for the wire: any move would power the servos again (X7). */
export async function release(core: Core, servos: readonly number[], clearMoves: () => void): Promise<void> {
  requireRest(core);
  const command = { kind: 'release', servos } as const;
  encodeOrRefuse(command, core.family);
  clearMoves();
  await core.exchange.tell(command);
}
