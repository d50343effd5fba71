// A board on this computer's serial port, through the browser's Web Serial: how a port is found again, packets out one at a time, bytes
// in as they come, and what each exception of the browser means for the link. Knows no packet beyond its length.

import type { ByteChannel } from '#shared/robot/byteChannel.ts';
import { sleep } from '#shared/clock.ts';
import { BAUD, wireMs } from '#shared/codec/packet.ts';
import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';
import { LINE_IDLE_MS } from '#shared/robot/timings.ts';
import { createTabChannel } from './tabChannel.ts';
import { portLabel, nameOf, createDeviceFinder, type DeviceFinder } from './browserDevices.ts';
import { browserClock } from './browserClock.ts';
import { createConnection, gone, settled, type Connection, type ConnectionEvents } from './connection.ts';

export function createWebSerialChannel(chosen: SerialPort): ByteChannel {
  const label = portLabel(chosen);
  const finder = createPortFinder(chosen);
  return createTabChannel({
    label,
    longestPacket: Infinity,
    lockName: `servodeck port ${label}`,
    connect: async (events) => openPort(await finder.find(), events),
    wentAway: finder.wentAway,
    watch(mayBeBack) {
      navigator.serial.addEventListener('connect', mayBeBack);
      return () => navigator.serial.removeEventListener('connect', mayBeBack);
    },
  });
}

function createPortFinder(chosen: SerialPort): DeviceFinder<SerialPort> {
  return createDeviceFinder<SerialPort>(chosen, {
    list: () => navigator.serial.getPorts(),
    isGone,
    isSameKind,
  });
}

/** Older browsers have no `connected`; they take a port that is gone from the list. */
function isGone({ connected }: { readonly connected?: boolean }): boolean {
  return connected === false;
}

function isSameKind(one: SerialPort, other: SerialPort): boolean {
  const [a, b] = [one.getInfo(), other.getInfo()];
  return a.usbVendorId !== undefined && a.usbVendorId === b.usbVendorId && a.usbProductId === b.usbProductId;
}

/**
 * Longer than a session waits for the rest of a packet: what the error cut is given up before anything is read that came
 * after it. And a line that stays disturbed (a board without power holds it low) does not keep the page busy.
 */
const LINE_ERROR_PAUSE_MS = LINE_IDLE_MS + 10;
/**
 * What was handed over last is a stop or a hold, and on a busy computer the browser needs tenths of a second to pass it on.
 * Only a driver that takes nothing at all needs longer.
 */
const DRAIN_WITHIN_MS = 1000;
/** Drivers and adapters call a packet sent while they hold it still; what a closed port held is thrown away. */
const HELD_BACK_MS = 100;
/** A port that does not let itself be closed is given up, so that another attempt can begin. */
const CLOSE_WITHIN_MS = 250;

export async function openPort(port: SerialPort, events: ConnectionEvents): Promise<Connection> {
  try {
    await port.open({ baudRate: BAUD });
  } catch (error) {
    throw new LinkError(openFailure(port, error), 'the port could not be opened', { cause: error });
  }
  return connect(port, events);
}

function openFailure(port: SerialPort, error: unknown): LinkErrorCode {
  if (nameOf(error) === 'SecurityError') return 'portDenied';
  return isGone(port) || nameOf(error) === 'NotFoundError' ? 'portMissing' : 'portBusy';
}

function connect(port: SerialPort, events: ConnectionEvents): Connection {
  let reader: ReadableStreamDefaultReader<Uint8Array> | null = null;
  let writer: WritableStreamDefaultWriter<Uint8Array> | null = null;
  let leftAtMs = -Infinity;

  // The opening is reported first, and then the loss.
  browserClock.after(0, () => void readAll());

  async function readAll(): Promise<void> {
    while (!connection.isClosing) {
      try {
        await readUntilError();
      } catch (error) {
        if (!isLineError(error)) {
          connection.lose(error);
          return;
        }
        await sleep(browserClock, LINE_ERROR_PAUSE_MS);
      }
    }
  }

  async function readUntilError(): Promise<never> {
    const source = streamOf(port.readable).getReader();
    reader = source;
    try {
      for (;;) {
        const { value, done } = await source.read();
        if (done) throw gone();
        if (!connection.isClosing) events.received(value);
      }
    } finally {
      letGo(source);
    }
  }

  function write(packet: Uint8Array): Promise<void> {
    writer ??= streamOf(port.writable).getWriter();
    return writer.write(packet);
  }

  async function end(): Promise<void> {
    // Closing a port throws away what its driver still holds; closing the stream first lets it leave.
    await Promise.race([settled(drain()), sleep(browserClock, DRAIN_WITHIN_MS)]);
    await Promise.race([shut(), sleep(browserClock, CLOSE_WITHIN_MS)]);
  }

  /** Rejects at once where the device is gone. */
  async function drain(): Promise<void> {
    await writer?.close();
    await sleep(browserClock, Math.max(0, leftAtMs + HELD_BACK_MS - browserClock.now()));
  }

  async function shut(): Promise<void> {
    await settled(reader?.cancel());
    if (reader !== null) letGo(reader);
    if (writer !== null) letGo(writer);
    await settled(port.close());
  }

  /** The driver takes the bytes at once; they are on the wire for much longer. */
  async function writeOut(packet: Uint8Array): Promise<void> {
    const startMs = browserClock.now();
    await write(packet);
    leftAtMs = Math.max(startMs + wireMs(packet.length), browserClock.now());
    await sleep(browserClock, leftAtMs - browserClock.now());
  }

  const connection = createConnection(
    { writeOut, end, sendAtOnce: (packet) => settled(writeOut(packet)) },
    events,
  );
  return connection;
}

function streamOf<T>(stream: T | null): T {
  if (stream === null) throw gone();
  return stream;
}

/** These leave the port usable with a fresh stream; everything else means that the device is gone. */
function isLineError(error: unknown): boolean {
  return ['BreakError', 'BufferOverrunError', 'FramingError', 'ParityError'].includes(nameOf(error));
}

function letGo(holder: { releaseLock(): void }): void {
  try {
    holder.releaseLock();
  } catch {
    return;
  }
}
