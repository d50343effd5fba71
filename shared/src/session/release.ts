// Takes the torque off servos: what they carry drops, and hands can pose them. Knows when that may be done; that a person has
// been warned is the page's affair.

import { requireRest, type Core } from './core.ts';
import { encodeOrRefuse } from './exchange.ts';
import { portions } from './portions.ts';

/** `clearMoves` drops what still waits for the wire: any move would power the servos again (X7). */
export async function release(core: Core, servos: readonly number[], clearMoves: () => void): Promise<void> {
  requireRest(core);
  const commands = portions(servos, core.family.servosPerMove).map(
    (some) => ({ kind: 'release', servos: some }) as const,
  );
  for (const command of commands) encodeOrRefuse(command, core.family);
  clearMoves();
  for (const command of commands) await core.exchange.tell(command);
}
