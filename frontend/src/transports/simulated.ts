// The simulated board in the page's own time.

import { createSimulatedTransport as create, type SimulatedTransport } from '#shared/simulator/transport.ts';
import { browserClock } from './browserClock.ts';

export function createSimulatedTransport(options?: Parameters<typeof create>[1]): SimulatedTransport {
  return create(browserClock, options);
}
