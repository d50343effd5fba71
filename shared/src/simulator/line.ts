// The serial line at the board's pins: bytes take their time on the wire, in both directions, and may be damaged, late or lost on
// it; what the board sends, and what becomes of an acknowledgement on purpose. Does not know why something is sent. The log has
// what the board's pins saw.

import type { Source, Work } from './agenda.ts';
import { type AckDamage, type FaultPlan, UNHARMED } from './faults.ts';
import { COMMAND_NUMBER } from '../codec/commands.ts';
import { packetBytes } from '../codec/packet.ts';

// One byte on the bus with its time, as the board's pins saw it: the oracle of tests.

export interface BusLogEntry {
  /** On the clock the board was given: when the byte's last bit was there. */
  readonly atMs: number;
  /** `in`: into the board. */
  readonly direction: 'in' | 'out';
  readonly byte: number;
}

// What the board has sent and the host has not got yet: late bytes hold up all behind them, as on any line.

export interface Outbox extends Source {
  /** The byte reaches the host `lateMs` from now, or when those before it have. */
  readonly put: (byte: number, lateMs: number) => void;
  /** What is on its way gets lost. */
  readonly drop: () => void;
  /** What has reached the host since the last call. */
  readonly take: () => Uint8Array;
}

const NOTHING = new Uint8Array(0);

export function createOutbox(now: () => number): Outbox {
  let onTheWay: { readonly atMs: number; readonly byte: number }[] = [];
  let arrived: number[] = [];

  function put(byte: number, lateMs: number): void {
    if (lateMs === 0 && onTheWay.length === 0) arrived.push(byte);
    else onTheWay.push({ atMs: Math.max(now() + lateMs, onTheWay.at(-1)?.atMs ?? 0), byte });
  }

  function take(): Uint8Array {
    if (arrived.length === 0) return NOTHING;
    const bytes = Uint8Array.from(arrived);
    arrived = [];
    return bytes;
  }

  function fire(): void {
    arrived.push(...onTheWay.filter(({ atMs }) => atMs <= now()).map(({ byte }) => byte));
    onTheWay = onTheWay.filter(({ atMs }) => atMs > now());
  }

  return { put, take, drop: () => void (onTheWay = []), dueMs: () => onTheWay[0]?.atMs ?? Infinity, fire };
}

interface LineParts {
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
  transmit(byte: number, damage: Pick<AckDamage, 'lost' | 'lateMs'>): void;
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

  function transmit(byte: number, { lost, lateMs }: Pick<AckDamage, 'lost' | 'lateMs'>): void {
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

// What the board says, byte by byte onto its line, and what becomes of an acknowledgement on purpose.

interface Sender {
  readonly reply: (command: number, params: readonly number[]) => Work;
  /** Plain ASCII. */
  readonly print: (text: string) => Work;
}

/** Replies that say no more than "taken" (S18-S20), each with another one's number for a foreign one. */
const FOREIGN_ACK: ReadonlyMap<number, number> = new Map([
  [COMMAND_NUMBER.run, COMMAND_NUMBER.erase],
  [COMMAND_NUMBER.erase, COMMAND_NUMBER.download],
  [COMMAND_NUMBER.download, COMMAND_NUMBER.run],
]);

export function createSender(line: () => Line, plan: FaultPlan): Sender {
  /** Sent by busy-waiting: each byte blocks the loop for its time on the wire (S21). */
  function* transmit(bytes: Iterable<number>, damage: AckDamage): Work {
    for (const byte of bytes) {
      yield line().byteMs;
      line().transmit(byte, damage);
    }
  }

  function* acknowledge(command: number, foreign: number): Work {
    const damage = plan.nextAck();
    if (damage.foreign) yield* transmit(packetBytes(foreign, []), UNHARMED);
    yield* transmit(packetBytes(command, []), damage);
    if (damage.doubled) yield* transmit(packetBytes(command, []), damage);
  }

  function reply(command: number, params: readonly number[]): Work {
    const foreign = params.length === 0 ? FOREIGN_ACK.get(command) : undefined;
    return foreign === undefined
      ? transmit(packetBytes(command, params), UNHARMED)
      : acknowledge(command, foreign);
  }

  return {
    reply,
    print: (text) =>
      transmit(
        Array.from(text, (letter) => letter.charCodeAt(0)),
        UNHARMED,
      ),
  };
}
