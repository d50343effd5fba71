// The outgoing order: stop lane first, then requests, then the newest move. Never more than one packet in flight and
// never sooner than the board's service gap after the one before. Knows packets as bytes; no replies, no meaning.

import { sleep, type Clock } from '../clock.ts';
import { LinkError } from './linkError.ts';

export interface LaneOptions {
  readonly clock: Clock;
  readonly serviceGapMs: number;
  /** Resolves when the packet's last bit has left the wire. */
  send(packet: Uint8Array): Promise<void>;
  /** Builds the newest move as late as possible, or null when there is nothing to say. */
  takeMove(): Uint8Array | null;
  sent(packet: Uint8Array): void;
  /** A move could not be sent; stops and requests reject instead. */
  moveFailed(error: LinkError): void;
}

export interface Lanes {
  /** Goes ahead of everything that has not begun to leave. */
  stop(packet: Uint8Array): Promise<void>;
  request(packet: Uint8Array): Promise<void>;
  /** Says that `takeMove` has something. */
  wake(): void;
  /** Rejects every request that has not begun to leave. Stops stay. */
  purge(error: LinkError): void;
}

interface Waiting {
  readonly packet: Uint8Array;
  readonly resolve: () => void;
  readonly reject: (error: unknown) => void;
}

export function createLanes(options: LaneOptions): Lanes {
  const stops: Waiting[] = [];
  const requests: Waiting[] = [];
  let pumping = false;

  const next = (): Waiting | null => stops.shift() ?? requests.shift() ?? newestMove();

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
    try {
      await options.send(packet);
    } catch (error) {
      reject(error);
      return;
    }
    options.sent(packet);
    resolve();
    await sleep(options.clock, options.serviceGapMs);
  }

  async function pump(): Promise<void> {
    if (pumping) return;
    pumping = true;
    for (let item = next(); item !== null; item = next()) await leave(item);
    pumping = false;
  }

  function enqueue(lane: Waiting[], packet: Uint8Array): Promise<void> {
    return new Promise((resolve, reject) => {
      lane.push({ packet, resolve, reject });
      void pump();
    });
  }

  return {
    stop: (packet) => enqueue(stops, packet),
    request: (packet) => enqueue(requests, packet),
    wake: () => void pump(),
    purge: (error) => requests.splice(0).forEach((waiting) => waiting.reject(error)),
  };
}

function asLinkError(error: unknown): LinkError {
  return error instanceof LinkError ? error : new LinkError('internal', String(error), { cause: error });
}
