// A link over a byte channel: packets out while it is open, and the events of the attempt that is under way. Knows no packet beyond its
// length.

import type { Clock } from '../clock.ts';
import type { ByteChannel, ChannelEvents } from './byteChannel.ts';
import { createLink, type LineState, type Link } from './link.ts';
import { LinkError } from './linkError.ts';

export interface ChannelLinkOptions extends Omit<ChannelEvents, 'lost' | 'available'> {
  readonly channel: ByteChannel;
  readonly clock: Clock;
  changed(state: LineState): void;
}

export interface ChannelLink extends Omit<Link, 'attempt' | 'lost' | 'available' | 'requireOpen'> {
  /** The page is about to go: hands the packet over before it returns, and the link is lost. */
  leave(lastPacket: Uint8Array): void;
  send(packet: Uint8Array): Promise<void>;
}

export function createChannelLink({ channel, clock, changed, ...events }: ChannelLinkOptions): ChannelLink {
  const link = createLink({
    ...{ clock, changed },
    open(options) {
      const mine = link.attempt;
      const isCurrent = (): boolean => mine === link.attempt;
      channel.events = {
        received: (bytes, whole) => isCurrent() && events.received(bytes, whole),
        unread: (bytes) => isCurrent() && events.unread(bytes),
        lost: (error) => isCurrent() && link.lost(error),
        available: link.available,
        claimed: async () => {
          if (isCurrent()) await events.claimed();
        },
      };
      return channel.open(options);
    },
    close: () => channel.close(),
  });

  async function send(packet: Uint8Array): Promise<void> {
    link.requireOpen();
    const mine = link.attempt;
    if (packet.length > channel.longestPacket)
      throw new LinkError('outOfRange', `${packet.length} bytes, the link carries ${channel.longestPacket}`);
    await channel.write(packet);
    // A channel may count the wire's time without looking at the cable.
    if (!link.isOpen || mine !== link.attempt)
      throw new LinkError('lost', 'the link went while the packet left');
  }

  return {
    get isOpen() {
      return link.isOpen;
    },
    open: link.open,
    close: link.close,
    retryNow: link.retryNow,
    takeOver: link.takeOver,
    setAutoReconnect: link.setAutoReconnect,
    leave(lastPacket) {
      if (!link.isOpen) return;
      void channel.close(lastPacket);
      link.lost(new LinkError('lost', 'the page was left'));
    },
    send,
  };
}
