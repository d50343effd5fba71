// A link over a byte channel: packets out while it is open, and bytes in, which become reports of the family. Knows no packet's meaning for
// the robot.

import type { Clock } from '../clock.ts';
import type { ByteChannel, ChannelEvents } from './byteChannel.ts';
import { createLink, type LineState, type Link } from './link.ts';
import { LinkError } from './linkError.ts';
import { createDecoder } from '../codec/decoder.ts';
import type { Family } from '../codec/families.ts';
import { parseReport } from '../codec/parse.ts';
import type { Report } from '../codec/reports.ts';
import { LINE_IDLE_MS, LINE_PAUSE_MS } from './timings.ts';

interface ChannelLinkOptions extends Omit<ChannelEvents, 'lost' | 'available'> {
  readonly channel: ByteChannel;
  readonly clock: Clock;
  changed(state: LineState): void;
}

interface ChannelLink extends Omit<Link, 'attempt' | 'lost' | 'abandon' | 'available' | 'requireOpen'> {
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
      void channel.close(link.isOpen ? lastPacket : undefined);
      link.abandon(new LinkError('lost', 'the page was left'));
    },
    send,
  };
}

interface ReceiverOptions {
  readonly clock: Clock;
  /** What the board is taken for at this moment. */
  family(): Family;
  report(report: Report, bytes: Uint8Array): void;
  noise(reason: 'garbage' | 'truncated', bytes: Uint8Array): void;
}

interface Receiver {
  /** `whole`: these bytes are whole packets, nothing that could belong to them will follow. */
  push(bytes: Uint8Array, whole: boolean): void;
  /** Forgets a half packet: a new connection starts clean. */
  reset(): void;
}

/** Feeds the decoder and notifies it of silence on the line. */
export function createReceiver({ clock, family, report, noise }: ReceiverOptions): Receiver {
  const decoder = createDecoder((event) => {
    if (event.kind === 'packet') report(parseReport(event.packet, family()), event.bytes);
    else noise(event.reason, event.bytes);
  });
  let cancelTimers: readonly (() => void)[] = [];

  function silenceBroken(): void {
    for (const cancel of cancelTimers) cancel();
  }

  return {
    push(bytes, whole) {
      silenceBroken();
      decoder.push(bytes);
      if (whole) decoder.pause();
      cancelTimers = [
        clock.after(LINE_PAUSE_MS, () => decoder.pause()),
        clock.after(LINE_IDLE_MS, () => decoder.idle()),
      ];
    },
    reset() {
      silenceBroken();
      decoder.reset();
    },
  };
}
