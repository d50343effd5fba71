// Listens for a board at other speeds of the port in use: here on a serial port of this computer, or at the gateway. Its link ends for that
// and comes back. What can be read is the caller's to say.

import { findGatewayRate, type FoundRate } from './gatewayPorts.ts';
import { findRate, type HeardAtRate } from './links/otherRates.ts';
import type { Opening } from './ways.ts';

export interface FindRateOptions {
  readonly isReadable: (heard: HeardAtRate) => boolean;
  detach(): Promise<void>;
  reopen(port: SerialPort): Promise<void>;
}

/** null where nothing that can be read arrives by itself. Rejects with a LinkError. */
export async function findRateOf(opening: Opening, options: FindRateOptions): Promise<FoundRate | null> {
  return opening.way().kind === 'gateway' ? findGatewayRate() : findHere(opening.port as SerialPort, options);
}

async function findHere(
  port: SerialPort,
  { isReadable, detach, reopen }: FindRateOptions,
): Promise<FoundRate | null> {
  await detach();
  try {
    const heard = await findRate(port, isReadable);
    return heard && { baud: heard.baud, kind: heard.packets > 0 ? 'packets' : 'text' };
  } finally {
    await reopen(port);
  }
}
