// The outgoing order: stops first, then requests, then the newest move. Never more than one packet in flight and
// never sooner than the board's service gap after the one before. Knows packets as bytes; no replies, no meaning.

import type { Clock } from '../clock.ts';
import { asLinkError, type LinkError } from './linkError.ts';

interface QueueOptions {
  readonly clock: Clock;
  readonly serviceGapMs: number;
  /** Resolves when the packet's last bit has left the wire. */
  send(packet: Uint8Array): Promise<void>;
  /** Builds the newest move as late as possible, or null when there is nothing to say. */
  takeMove(): Uint8Array | null;
  /** Its first bit is about to leave. */
  leaving(packet: Uint8Array): void;
  sent(packet: Uint8Array): void;
  /** A move could not be sent; stops and requests reject instead. */
  moveFailed(error: LinkError): void;
}

export interface Queue {
  /** Goes ahead of everything that has not begun to leave. One that is built then may turn out to be nothing. */
  stop(packet: Uint8Array | (() => Uint8Array | null)): Promise<void>;
  request(packet: Uint8Array): Promise<void>;
  /** Says that `takeMove` has something. */
  wake(): void;
  /** The board answered a packet with that command number: if it left last, the board is free and the gap is over. */
  answered(command: number): void;
  /** The packet that has not left the wire for sure: it is leaving, or it failed on the way and none has left since. */
  unfinished(): Uint8Array | null;
  /** The line is open: what left before, also from others, may be on the wire still. */
  returned(): void;
  /** Rejects every request that has not begun to leave. Stops stay. */
  purge(error: LinkError): void;
}

interface Settle {
  readonly resolve: () => void;
  readonly reject: (error: unknown) => void;
}

interface Waiting extends Settle {
  readonly packet: Uint8Array;
}

interface WaitingStop extends Settle {
  build(): Uint8Array | null;
}

export function createQueue(options: QueueOptions): Queue {
  const stops: WaitingStop[] = [];
  const requests: Waiting[] = [];
  let pumping = false;
  /** Command numbers of the packet that leaves or left last, and of the board's latest answer to it. */
  let lastCommand: number | undefined;
  let lastAnswer: number | undefined;
  let unfinished: Uint8Array | null = null;
  let endGap = (): void => undefined;
  let returning: Promise<void> | null = null;

  const next = (): Waiting | null => nextStop() ?? requests.shift() ?? newestMove();

  function nextStop(): Waiting | null {
    for (let stop = stops.shift(); stop !== undefined; stop = stops.shift()) {
      const { build, resolve, reject } = stop;
      try {
        const packet = build();
        if (packet !== null) return { packet, resolve, reject };
        resolve();
      } catch (error) {
        reject(error);
      }
    }
    return null;
  }

  function newestMove(): Waiting | null {
    const packet = options.takeMove();
    return (
      packet && {
        packet,
        resolve: () => undefined,
        reject: (error) => options.moveFailed(asLinkError(error)),
      }
    );
  }

  async function leave({ packet, resolve, reject }: Waiting): Promise<void> {
    lastCommand = packet[3];
    lastAnswer = undefined;
    options.leaving(packet);
    unfinished = packet;
    try {
      await options.send(packet);
    } catch (error) {
      reject(error);
      return;
    }
    unfinished = null;
    options.sent(packet);
    resolve();
    if (lastAnswer !== lastCommand) await gap();
  }

  function gap(): Promise<void> {
    return new Promise((resolve) => {
      const cancelTimer = options.clock.after(options.serviceGapMs, resolve);
      endGap = () => {
        cancelTimer();
        resolve();
      };
    });
  }

  async function pump(): Promise<void> {
    if (pumping) return;
    pumping = true;
    if (returning !== null) await returning;
    returning = null;
    for (let item = next(); item !== null; item = next()) await leave(item);
    pumping = false;
  }

  function enqueue(put: (settle: Settle) => void): Promise<void> {
    return new Promise((resolve, reject) => {
      put({ resolve, reject });
      void pump();
    });
  }

  return {
    stop(packet) {
      const build = typeof packet === 'function' ? packet : () => packet;
      return enqueue((settle) => stops.push({ ...settle, build }));
    },
    request: (packet) => enqueue((settle) => requests.push({ ...settle, packet })),
    wake: () => void pump(),
    answered(command) {
      lastAnswer = command;
      if (command === lastCommand) endGap();
    },
    unfinished: () => unfinished,
    returned: () => void (returning = gap()),
    purge(error) {
      requests.splice(0).forEach((waiting) => waiting.reject(error));
    },
  };
}
