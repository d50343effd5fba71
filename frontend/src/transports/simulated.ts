// The simulated board in the page's own time.

import { createSimulatedTransport as create, type SimulatedTransport } from '#shared/simulator/transport.ts';
import { browserClock } from './browserClock.ts';

/** The board was switched on before the page came: it answers at once and knows its battery. */
const LONG_SINCE_MS = 60_000;

export function createSimulatedTransport(options?: Parameters<typeof create>[1]): SimulatedTransport {
  return create(browserClock, { onForMs: LONG_SINCE_MS, ...options });
}
