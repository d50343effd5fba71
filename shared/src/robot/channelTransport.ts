// A byte channel as the session's link: a robot that nobody shares.

import type { ByteChannel } from './byteChannel.ts';
import type { Transport } from './transport.ts';

export function overChannel(channel: ByteChannel, kind: Transport['kind']): Transport {
  let notifyAvailable = (): void => undefined;
  return {
    kind,
    isSimulated: kind === 'simulated',
    longestPacket: channel.longestPacket,
    get label() {
      return channel.label;
    },
    async open(events, options) {
      channel.events = {
        received: (bytes, whole) => events.received(bytes, whole),
        unread: (bytes) => events.unread?.(bytes),
        lost: (error) => events.lost(error),
        available: () => notifyAvailable(),
        claimed: async () => events.claimed?.(),
      };
      await channel.open(options);
    },
    send: (packet) => channel.write(packet),
    whenAvailable(notify) {
      notifyAvailable = notify;
      return () => (notifyAvailable = () => undefined);
    },
    close: (lastPacket) => channel.close(lastPacket),
  };
}
