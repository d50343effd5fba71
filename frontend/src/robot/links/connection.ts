// An open device, from opening to closing, whatever it is: it is sent to, and it ends once, by `close` or by itself. Knows no kind of
// device and no packets.

import type { ChannelEvents } from '#shared/robot/byteChannel.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import { browserClock } from './browserClock.ts';

export interface ConnectionEvents extends Pick<ChannelEvents, 'received' | 'unread'> {
  /** At most once, never after `close`. */
  lost(error: LinkError): void;
}

export interface Connection {
  /** Resolves when the packet's last bit has left the wire. Any failure ends the connection. */
  send(packet: Uint8Array): Promise<void>;
  /** Hands the packet over before it returns, behind what is leaving. Resolves when it has left, or never will. */
  sendAtOnce(packet: Uint8Array): Promise<void>;
  /** Never rejects and never hangs. */
  close(): Promise<void>;
}

interface ConnectionParts {
  /** Resolves when the packet's last bit has left the wire. */
  writeOut(packet: Uint8Array): Promise<void>;
  sendAtOnce(packet: Uint8Array): Promise<void>;
  /** Closes the device. `isGone`: nothing that was handed over will leave any more. */
  end(isGone: boolean): Promise<void>;
}

interface LosableConnection extends Connection {
  readonly isClosing: boolean;
  /** The device is gone. */
  lose(cause?: unknown): void;
}

export function createConnection(
  { writeOut, sendAtOnce, end }: ConnectionParts,
  events: Pick<ConnectionEvents, 'lost'>,
): LosableConnection {
  let closing: Promise<void> | null = null;
  let failSending = (_error: LinkError): void => undefined;

  function close(isGone = false): Promise<void> {
    closing ??= end(isGone);
    failSending(gone());
    return closing;
  }

  /** A device that is gone may take its time to close: its loss is said first. */
  function lose(cause?: unknown): void {
    if (closing !== null) return;
    const error = gone(cause);
    void close(true);
    events.lost(error);
  }

  return {
    get isClosing() {
      return closing !== null;
    },
    send(packet) {
      if (closing !== null) return Promise.reject(gone());
      return new Promise((resolve, reject) => {
        failSending = reject;
        writeOut(packet).then(resolve, (error: unknown) => {
          lose(error);
          reject(gone(error));
        });
      });
    },
    sendAtOnce,
    close: () => close(),
    lose,
  };
}

export function gone(cause?: unknown): LinkError {
  return new LinkError('lost', 'the device is gone', { cause });
}

/** Browsers leave some promises open for ever where a device went at the wrong moment. */
export function within<T>(limitMs: number, work: Promise<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    const cancel = browserClock.after(limitMs, () => reject(gone()));
    work.then(resolve, reject).finally(cancel);
  });
}

/** Its failure changes nothing: it was about to end. */
export async function settled(work: Promise<unknown> | undefined): Promise<void> {
  await work?.catch(() => undefined);
}
