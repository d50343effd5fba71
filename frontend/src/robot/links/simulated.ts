// The simulated board in the page's own time.

import {
  createSimulatedChannel as create,
  type SimulatedChannel,
  type SimulatedChannelOptions,
} from '#shared/simulator/channel.ts';
import { browserClock } from './browserClock.ts';

export function createSimulatedChannel(options?: SimulatedChannelOptions): SimulatedChannel {
  return create(browserClock, options);
}
