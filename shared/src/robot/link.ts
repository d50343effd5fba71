// One channel's life: opening, open, lost and back again. Knows the clock; nothing of packets, nor which board is at the other end.
// Every failure leaves here as a LinkError.

import type { Clock } from '../clock.ts';
import type { ByteChannel, ChannelEvents, OpenOptions } from './byteChannel.ts';
import { asLinkError, LinkError, passesByItself } from './linkError.ts';
import { createReconnect } from './reconnect.ts';
import type { LinkState } from './state.ts';

/** What the line itself can be; who answers on it is decided above. */
export type LineState =
  | Extract<LinkState, { status: 'closed' | 'opening' | 'lost' | 'refused' }>
  | { readonly status: 'open'; readonly isReturn: boolean };

export interface LinkOptions extends Omit<ChannelEvents, 'lost' | 'available'> {
  readonly channel: ByteChannel;
  readonly clock: Clock;
  changed(state: LineState): void;
}

export interface Link {
  readonly isOpen: boolean;
  open(): Promise<void>;
  close(): Promise<void>;
  retryNow(): void;
  /** An attempt now, before which another tab lets go of the device. Rejects with `heldElsewhere` where it does not. */
  takeOver(): Promise<void>;
  /** The page is about to go: hands the packet over before it returns, and the link is lost. */
  leave(lastPacket: Uint8Array): void;
  setAutoReconnect(enabled: boolean): void;
  send(packet: Uint8Array): Promise<void>;
}

export function createLink({ channel, clock, changed, ...events }: LinkOptions): Link {
  let state: LineState = { status: 'closed' };
  let wasOpenBefore = false;
  let mayBeBack = (): void => undefined;
  /** Counts connections, so that a late word of an old one is not taken for the new one's. */
  let generation = 0;

  const isOpen = (connection: number): boolean => state.status === 'open' && connection === generation;
  const isDown = (): boolean => state.status === 'lost' || state.status === 'refused';

  const reconnect = createReconnect({
    clock,
    attempt: retry,
    watch(notify) {
      mayBeBack = notify;
      return () => (mayBeBack = () => undefined);
    },
    planned(retryAtMs) {
      if (state.status === 'lost') enter({ ...state, retryAtMs });
    },
  });

  function enter(next: LineState): void {
    state = next;
    changed(next);
  }

  function fail(error: LinkError): void {
    const passes = passesByItself(error);
    const retryAtMs = reconnect.plan(passes);
    enter(passes ? { status: 'lost', error, retryAtMs } : { status: 'refused', error });
  }

  function retry(): void {
    reconnect.rest();
    // The failure is in the state; there is no caller to tell.
    connect().catch(() => undefined);
  }

  async function connect(options?: OpenOptions): Promise<void> {
    const mine = (generation += 1);
    if (!isDown()) enter({ status: 'opening' });
    const isCurrent = (): boolean => mine === generation;
    channel.events = {
      received: (bytes, whole) => isCurrent() && events.received(bytes, whole),
      unread: (bytes) => isCurrent() && events.unread(bytes),
      lost: (error) => isCurrent() && fail(error),
      available: () => mayBeBack(),
      claimed: async () => {
        if (isCurrent()) await events.claimed();
      },
    };
    try {
      await channel.open(options);
    } catch (error) {
      const reason = asLinkError(error);
      if (mine === generation) fail(reason);
      throw reason;
    }
    if (mine !== generation) return;
    reconnect.refresh();
    const isReturn = wasOpenBefore;
    wasOpenBefore = true;
    enter({ status: 'open', isReturn });
  }

  async function send(packet: Uint8Array): Promise<void> {
    const mine = generation;
    if (!isOpen(mine))
      throw isDown()
        ? new LinkError('lost', 'the link is gone')
        : new LinkError('closed', 'the link is not open');
    if (packet.length > channel.longestPacket)
      throw new LinkError('outOfRange', `${packet.length} bytes, the link carries ${channel.longestPacket}`);
    await channel.write(packet);
    // A channel may count the wire's time without looking at the cable.
    if (!isOpen(mine)) throw new LinkError('lost', 'the link went while the packet left');
  }

  return {
    get isOpen() {
      return state.status === 'open';
    },
    open() {
      reconnect.rest();
      reconnect.refresh();
      return connect();
    },
    async close() {
      reconnect.rest();
      generation += 1;
      wasOpenBefore = false;
      if (state.status !== 'closed') enter({ status: 'closed' });
      await channel.close();
    },
    retryNow() {
      if (isDown()) retry();
    },
    takeOver() {
      reconnect.rest();
      return connect({ takesOver: true });
    },
    leave(lastPacket) {
      if (state.status !== 'open') return;
      void channel.close(lastPacket);
      fail(new LinkError('lost', 'the page was left'));
    },
    setAutoReconnect: reconnect.setEnabled,
    send,
  };
}
