// A link whose other end is a recording: it says what the board said, when it is told to. Knows packets as bytes.

import { sleep, type Clock } from '../clock.ts';
import { wireMs } from '../codec/packet.ts';
import { LinkError } from '../session/linkError.ts';
import type { Transport, TransportEvents } from '../session/transport.ts';

export interface ReplayTransport extends Transport {
  /** `whole` where they are packets, as the recording has them. */
  say(bytes: Uint8Array, whole: boolean): void;
  /** Another screen or a loss latched the shared link. */
  latch(): void;
  lose(): void;
  comeBack(): void;
}

export function createReplayTransport(clock: Clock): ReplayTransport {
  let events: TransportEvents | null = null;
  let isThere = true;
  let notifyAvailable = (): void => undefined;

  return {
    kind: 'simulated',
    isSimulated: true,
    longestPacket: Infinity,
    label: 'Recording',
    open(next) {
      if (!isThere) return Promise.reject(new LinkError('portMissing', 'the recording has no link here'));
      events = next;
      return Promise.resolve();
    },
    send: (packet) => sleep(clock, wireMs(packet.length)),
    whenAvailable(notify) {
      notifyAvailable = notify;
      return () => (notifyAvailable = () => undefined);
    },
    close() {
      events = null;
      return Promise.resolve();
    },
    say: (bytes, whole) => events?.received(bytes, whole),
    latch: () => events?.latched?.('elsewhere'),
    lose() {
      const told = events;
      events = null;
      isThere = false;
      told?.lost(new LinkError('lost', 'the link went'));
    },
    comeBack() {
      isThere = true;
      notifyAvailable();
    },
  };
}
