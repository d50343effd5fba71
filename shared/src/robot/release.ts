// Takes the torque off servos: what they carry drops, and hands can pose them. Knows when that may be done; that a person has
// been warned is the page's affair.

import { requireRest, type Core } from './core.ts';
import { encodeOrRefuse } from './exchange.ts';
import { portions } from './portions.ts';

/** At rest only: a move that goes on or still waits for the wire would power them again (X7). */
export async function release(core: Core, servos: readonly number[]): Promise<void> {
  requireRest(core);
  const commands = portions(servos, core.servosPerMove).map(
    (some) => ({ kind: 'release', servos: some }) as const,
  );
  for (const command of commands) encodeOrRefuse(command, core.family);
  if (core.commands !== undefined) await core.commands.release(servos);
  else for (const command of commands) await core.exchange.tell(command);
}
