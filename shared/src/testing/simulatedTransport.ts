// A simulated board as a session's link, for tests that watch or change what passes between them.

import type { Clock } from '../clock.ts';
import {
  createSimulatedChannel,
  type SimulatedChannel,
  type SimulatedChannelOptions,
} from '../simulator/channel.ts';
import { overChannel } from '../robot/channelTransport.ts';
import type { Transport } from '../robot/transport.ts';

export type SimulatedTransport = Transport & Pick<SimulatedChannel, 'board' | 'unplug' | 'plugIn'>;

export function createSimulatedTransport(
  clock: Clock,
  options?: SimulatedChannelOptions,
): SimulatedTransport {
  const channel = createSimulatedChannel(clock, options);
  const { board, unplug, plugIn } = channel;
  return Object.assign(overChannel(channel, 'simulated'), { board, unplug, plugIn });
}
