// A board in the page, behind the same six members as a real cable. Knows the simulator and how long a packet is on the wire.

import { sleep, type Clock } from '../clock.ts';
import { wireMs } from '../codec/packet.ts';
import type { ByteChannel } from '../robot/byteChannel.ts';
import { LinkError } from '../robot/linkError.ts';
import { createBoard, type Board, type BoardOptions } from './board.ts';

export interface SimulatedChannel extends ByteChannel {
  readonly board: Board;
  /** Pulls the cable: the link is lost and opening it fails until `plugIn`. The board itself continues. */
  unplug(): void;
  plugIn(): void;
}

export interface SimulatedChannelOptions extends Omit<BoardOptions, 'clock' | 'send' | 'onUnplug'> {
  readonly longestPacket?: number;
}

export function createSimulatedChannel(
  clock: Clock,
  { longestPacket = Infinity, ...options }: SimulatedChannelOptions = {},
): SimulatedChannel {
  let isOpen = false;
  let isPlugged = true;
  const board = createBoard({ ...options, clock, send: received, onUnplug: cut });

  function received(bytes: Uint8Array): void {
    if (isOpen) channel.events?.received(bytes);
  }

  function cut(): void {
    const wasOpen = isOpen;
    isPlugged = false;
    isOpen = false;
    if (wasOpen) channel.events?.lost(new LinkError('lost', 'the simulated cable was pulled'));
  }

  const channel: SimulatedChannel = {
    label: 'Simulated board',
    longestPacket,
    events: null,
    board,
    open() {
      if (!isPlugged) return Promise.reject(new LinkError('portMissing', 'the simulated cable is pulled'));
      isOpen = true;
      return Promise.resolve();
    },
    async write(packet) {
      if (!isOpen) throw new LinkError('lost', 'the simulated cable is pulled');
      board.receive(packet);
      await sleep(clock, wireMs(packet.length));
    },
    close() {
      isOpen = false;
      return Promise.resolve();
    },
    unplug: () => board.unplug(),
    plugIn() {
      isPlugged = true;
      board.plugIn();
      channel.events?.available();
    },
  };
  return channel;
}
