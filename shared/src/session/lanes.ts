// The outgoing order: stop lane first, then requests, then the newest move. Never more than one packet in flight and
// never sooner than the board's service gap after the one before; where the link keeps that itself and is far away, moves do
// not wait for its word. Knows packets as bytes; no replies, no meaning.

import { sleep, type Clock } from '../clock.ts';
import { wireMs } from '../protocol/packet.ts';
import { LinkError } from './linkError.ts';
import { REFRESH_MS, LATE_SHARE } from './timings.ts';

/** A move, and where a newer one may take its place: what to call when it is handed over, then once it has left or failed. */
export interface Outgoing {
  readonly packet: Uint8Array;
  readonly handed?: () => () => void;
}

export interface LaneOptions {
  readonly clock: Clock;
  readonly serviceGapMs: number;
  /** Resolves when the packet's last bit has left the wire. */
  send(packet: Uint8Array): Promise<void>;
  /** Where the link holds a move until the wire is free: resolves with whether it left or a newer one took its place. */
  readonly sendNewest?: ((packet: Uint8Array) => Promise<boolean>) | undefined;
  /** Builds the newest move as late as possible, or null when there is nothing to say. */
  takeMove(): Outgoing | null;
  /** Its first bit is about to leave. */
  leaving(packet: Uint8Array): void;
  sent(packet: Uint8Array): void;
  /** A move could not be sent; stops and requests reject instead. */
  moveFailed(error: LinkError): void;
}

export interface Lanes {
  /** Goes ahead of everything that has not begun to leave. One that is built then may turn out to be nothing. */
  stop(packet: Uint8Array | (() => Uint8Array | null)): Promise<void>;
  request(packet: Uint8Array): Promise<void>;
  /** Says that `takeMove` has something. */
  wake(): void;
  /** The board answered a packet with that command number: if it left last, the board is free and the gap is over. */
  answered(command: number): void;
  /** The packet that has not left the wire for sure: it is leaving, or it failed on the way and none has left since. */
  unfinished(): Uint8Array | null;
  /** Rejects every request that has not begun to leave, and hears of moves no more that the link holds. Stops stay. */
  purge(error: LinkError): void;
}

interface Settle {
  readonly resolve: () => void;
  readonly reject: (error: unknown) => void;
}

type Waiting = Outgoing & Settle;

interface WaitingStop extends Settle {
  build(): Uint8Array | null;
}

type Hold = NonNullable<LaneOptions['sendNewest']>;

export function createLanes(options: LaneOptions): Lanes {
  const stops: WaitingStop[] = [];
  const requests: Waiting[] = [];
  let pumping = false;
  /** Command numbers of the packet that leaves or left last, and of the board's latest answer to it. */
  let lastCommand: number | undefined;
  let lastAnswer: number | undefined;
  let unfinished: Uint8Array | null = null;
  let endGap = (): void => undefined;
  /** Moves that the link holds, or has sent without its word being here yet. A purge forgets them. */
  let held = new Set<Uint8Array>();

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
    const move = options.takeMove();
    return (
      move && {
        ...move,
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

  /** Never rejects. */
  async function hold(packet: Uint8Array, sendNewest: Hold, done: () => void): Promise<void> {
    const among = held.add(packet);
    const outcome = await sendNewest(packet).catch(asLinkError);
    among.delete(packet);
    if (outcome === false || held !== among) return;
    done();
    if (outcome !== true) {
      options.moveFailed(outcome);
      return;
    }
    options.leaving(packet);
    options.sent(packet);
  }

  /**
   * A link that answers in time is given the next move when the wire is free, as new as can be. One that is slower is given moves
   * all the time, and the newest of them leaves.
   */
  async function stream(packet: Uint8Array, sendNewest: Hold, done: () => void): Promise<void> {
    const isAlone = held.size === 0;
    const handedMs = options.clock.now();
    const answered = hold(packet, sendNewest, done);
    const packetMs = wireMs(packet.length);
    const cycleMs = packetMs + options.serviceGapMs;
    if (!isAlone) return sleep(options.clock, REFRESH_MS);
    const isPrompt = await within(options.clock, packetMs + cycleMs * LATE_SHARE, answered);
    const lateMs = options.clock.now() - handedMs - packetMs;
    // Half of what the answer is late the way there takes: the link's own pause began that much earlier.
    await sleep(options.clock, Math.max(0, options.serviceGapMs - (isPrompt ? lateMs / 2 : lateMs)));
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
    for (let item = next(); item !== null; item = next()) {
      if (item.handed && options.sendNewest) await stream(item.packet, options.sendNewest, item.handed());
      else await leave(item);
    }
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
    unfinished: () => unfinished ?? [...held].at(-1) ?? null,
    purge(error) {
      held = new Set();
      requests.splice(0).forEach((waiting) => waiting.reject(error));
    },
  };
}

/** Whether it comes in time. */
function within(clock: Clock, ms: number, done: Promise<void>): Promise<boolean> {
  return new Promise((resolve) => {
    const cancelTimer = clock.after(ms, () => resolve(false));
    void done.then(() => {
      cancelTimer();
      resolve(true);
    });
  });
}

function asLinkError(error: unknown): LinkError {
  return error instanceof LinkError ? error : new LinkError('internal', String(error), { cause: error });
}
