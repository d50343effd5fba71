// The serial line at the board's pins: bytes take their time on the wire, in both directions, and may be damaged on it.
// Knows bytes and a baud rate; does not know packets. What it logs is what the board's pins saw.

import type { Source } from './agenda.ts';
import type { BusLogEntry } from './busLog.ts';
import type { AckFate, FaultPlan } from './faults.ts';
import { createOutbox } from './outbox.ts';

export interface LineParts {
  readonly now: () => number;
  readonly byteMs: number;
  readonly plan: FaultPlan;
  /** A byte has arrived at the board. */
  readonly arrived: (byte: number) => void;
  readonly log: (direction: BusLogEntry['direction'], byte: number) => void;
}

export interface Line extends Source {
  readonly byteMs: number;
  /** The host starts to send; each byte completes after the one before it. */
  receive(bytes: Uint8Array): void;
  /** One byte has left the board; lost ones never reach the host, late ones later. */
  transmit(byte: number, fate: Pick<AckFate, 'lost' | 'lateMs'>): void;
  /** Brings late bytes to the host. */
  readonly outbox: Source;
  /** What reached the host since the last call. */
  takeSent(): Uint8Array;
  /** Bytes of the host that have not arrived yet. */
  waitingBytes(): number;
  isPlugged(): boolean;
  plug(plugged: boolean): void;
}

export function createLine({ now, byteMs, plan, arrived, log }: LineParts): Line {
  let queue: { readonly atMs: number; readonly bytes: Uint8Array }[] = [];
  let headIndex = 0;
  let waiting = 0;
  let lineFreeMs = 0;
  const outbox = createOutbox(now);
  let plugged = true;
  let bytesOnWire = 0;

  /** Counts and logs a byte; at the chosen one the cable comes off behind it. */
  function pass(direction: BusLogEntry['direction'], byte: number): void {
    log(direction, byte);
    bytesOnWire += 1;
    if (bytesOnWire === plan.unplugAtByte) plug(false);
  }

  function plug(wanted: boolean): void {
    plugged = wanted;
    if (plugged) return;
    queue = [];
    headIndex = 0;
    waiting = 0;
    outbox.drop();
  }

  function receive(bytes: Uint8Array): void {
    if (!plugged || bytes.length === 0) return;
    queue.push({ atMs: now(), bytes: bytes.slice() });
    waiting += bytes.length;
  }

  function dueMs(): number {
    const head = queue[0];
    return head ? Math.max(head.atMs, lineFreeMs) + byteMs : Infinity;
  }

  function takeHead(): number {
    const byte = queue[0]?.bytes[headIndex] ?? 0;
    headIndex += 1;
    waiting -= 1;
    if (headIndex === queue[0]?.bytes.length) {
      queue.shift();
      headIndex = 0;
    }
    return byte;
  }

  function fire(): void {
    lineFreeMs = dueMs();
    for (const byte of plan.distort(takeHead())) {
      pass('in', byte);
      arrived(byte);
      if (plan.loopsBack) outbox.put(byte, 0);
    }
  }

  function transmit(byte: number, { lost, lateMs }: Pick<AckFate, 'lost' | 'lateMs'>): void {
    if (!plugged) return;
    pass('out', byte);
    if (lost) return;
    for (const heard of plan.distort(byte)) outbox.put(heard, lateMs);
  }

  return {
    byteMs,
    receive,
    dueMs,
    fire,
    transmit,
    takeSent: outbox.take,
    outbox,
    waitingBytes: () => waiting,
    isPlugged: () => plugged,
    plug,
  };
}
