// A board on this computer's serial port, through the browser's Web Serial. Knows ports, permissions and what each
// DOMException means for the person; no packets beyond their length.

import { wireMs, BAUD } from '#shared/protocol/packet.ts';
import { LinkError, type LinkErrorCode } from '#shared/session/linkError.ts';
import type { Transport, TransportEvents } from '#shared/session/transport.ts';

/** Why Web Serial cannot be used here, or null when it can. An insecure address hides it in every browser. */
export function webSerialObstacle(): Extract<LinkErrorCode, 'insecureAddress' | 'unsupported'> | null {
  if (!window.isSecureContext) return 'insecureAddress';
  return 'serial' in navigator ? null : 'unsupported';
}

/** Ports the person has allowed before; opening them needs no chooser. */
export async function grantedPorts(): Promise<readonly SerialPort[]> {
  return webSerialObstacle() === null ? navigator.serial.getPorts() : [];
}

/** Opens the browser's chooser; needs a click. Rejects with `notChosen` when it is closed without a choice. */
export async function choosePort(): Promise<SerialPort> {
  try {
    return await navigator.serial.requestPort();
  } catch (error) {
    const code = nameOf(error) === 'NotFoundError' ? 'notChosen' : 'portDenied';
    throw new LinkError(code, 'no port was chosen', { cause: error });
  }
}

export function createWebSerialTransport(chosen: SerialPort): Transport {
  let port = chosen;
  let connection: Connection | null = null;

  return {
    kind: 'webSerial',
    isSimulated: false,
    label: portLabel(chosen),
    async open(events) {
      await connection?.close();
      port = await findAgain(port);
      await openPort(port);
      connection = connect(port, events);
    },
    async send(packet) {
      if (connection === null) throw new LinkError('closed', 'the port is not open');
      await connection.send(packet);
    },
    whenAvailable(notify) {
      navigator.serial.addEventListener('connect', notify);
      return () => {
        navigator.serial.removeEventListener('connect', notify);
      };
    },
    async close() {
      await connection?.close();
      connection = null;
    },
  };
}

function portLabel(port: SerialPort): string {
  const { usbVendorId, usbProductId } = port.getInfo();
  if (usbVendorId === undefined) return 'Serial port';
  const hex = (id: number | undefined): string => (id ?? 0).toString(16).toUpperCase().padStart(4, '0');
  return `USB serial ${hex(usbVendorId)}:${hex(usbProductId)}`;
}

/** After a replug the browser hands out a new object for the same device: match it by its USB ids. */
async function findAgain(port: SerialPort): Promise<SerialPort> {
  const granted = await navigator.serial.getPorts();
  const { usbVendorId, usbProductId } = port.getInfo();
  const twin = granted.find((other) => {
    const info = other.getInfo();
    return info.usbVendorId === usbVendorId && info.usbProductId === usbProductId;
  });
  const found = granted.includes(port) ? port : twin;
  if (found === undefined) throw new LinkError('portMissing', 'the port is not there');
  return found;
}

async function openPort(port: SerialPort): Promise<void> {
  try {
    await port.open({ baudRate: BAUD });
  } catch (error) {
    const code = nameOf(error) === 'SecurityError' ? 'portDenied' : 'portBusy';
    throw new LinkError(code, 'the port could not be opened', { cause: error });
  }
}

interface Connection {
  send(packet: Uint8Array): Promise<void>;
  close(): Promise<void>;
}

function connect(port: SerialPort, events: TransportEvents): Connection {
  let reader: ReadableStreamDefaultReader<Uint8Array> | null = null;
  let closing = false;
  const reading = readAll();

  async function readAll(): Promise<void> {
    while (!closing && port.readable !== null) {
      reader = port.readable.getReader();
      try {
        await readUntilError(reader);
      } catch (error) {
        if (!isPassing(error)) break;
      } finally {
        reader.releaseLock();
      }
    }
    if (!closing) {
      await port.close().catch(() => undefined);
      events.lost(new LinkError('lost', 'the device is gone'));
    }
  }

  async function readUntilError(source: ReadableStreamDefaultReader<Uint8Array>): Promise<void> {
    for (;;) {
      const { value, done } = await source.read();
      if (done) return;
      events.received(value);
    }
  }

  return {
    async send(packet) {
      const startMs = performance.now();
      const writer = port.writable?.getWriter();
      if (writer === undefined) throw new LinkError('lost', 'the device is gone');
      try {
        await writer.write(packet);
      } catch (error) {
        throw new LinkError('lost', 'the device is gone', { cause: error });
      } finally {
        writer.releaseLock();
      }
      // The driver takes the bytes at once; they are on the wire for much longer.
      await delay(startMs + wireMs(packet.length) - performance.now());
    },
    async close() {
      closing = true;
      await reader?.cancel().catch(() => undefined);
      await reading;
      await port.close().catch(() => undefined);
    },
  };
}

/** Line errors leave the port usable with a fresh stream; everything else means that the device is gone. */
function isPassing(error: unknown): boolean {
  return ['BreakError', 'BufferOverrunError', 'FramingError', 'ParityError'].includes(nameOf(error));
}

function nameOf(error: unknown): string {
  return error instanceof DOMException ? error.name : '';
}

function delay(ms: number): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, Math.max(0, ms)));
}
