// What a robot on a link of its own needs of a cable or a radio: six members. A channel carries whole packets out and raw bytes
// in; it knows no command, keeps no queue and repeats nothing. A new way to a board is one file that implements this.

import type { LinkError } from './linkError.ts';

export interface ChannelEvents {
  /** Bytes from the board, in order, in pieces of any size; `whole` where they are a whole packet for sure. */
  received(bytes: Uint8Array, whole?: boolean): void;
  /** Bytes that belong to no packet for sure: for the log. */
  unread(bytes: Uint8Array): void;
  /** The open channel ended by itself. At most once after each `open`, never after `close`. */
  lost(error: LinkError): void;
  /** The device may be back: worth an attempt before the next one is due. Only while the channel is not open. */
  available(): void;
  /** Another tab requests the device. The robot is stopped meanwhile; then, or after a bounded time, the channel lets go of it. */
  claimed(): Promise<void>;
}

export interface OpenOptions {
  /** Another tab that has the device stops its robot and lets go of it first. */
  readonly takesOver?: boolean;
}

export interface ByteChannel {
  /** Names the device for people, e.g. `CH340 USB serial adapter`. */
  readonly label: string;
  /** In bytes; Infinity where a packet of any length passes. Longer ones never reach `write`. */
  readonly longestPacket: number;
  /** Each packet leaves in a frame of its own: what others left unfinished on the line is no part of it. Absent: it does not. */
  readonly inReports?: boolean;
  /** Set before `open`; each attempt may set another. null: no listener. */
  events: ChannelEvents | null;
  /** Rejects with a LinkError, in bounded time. May be called again after `lost`, `close` or a failure. */
  open(options?: OpenOptions): Promise<void>;
  /**
   * One packet at a time: the caller waits until it resolves, which is when the packet's last bit has left the wire, and no
   * sooner than the channel takes another packet. Rejects with a LinkError, in bounded time.
   */
  write(packet: Uint8Array): Promise<void>;
  /**
   * Never rejects; closing twice is harmless. With `lastPacket`, where the page is about to go: that packet is handed over
   * before `close` returns, behind one that is leaving.
   */
  close(lastPacket?: Uint8Array): Promise<void>;
}
