// A browser's serial ports for tests, below the transport: real streams, and at each step an exception that a test requested
// for, once. Also the locks and channels between the tabs of one browser. Time is the test's.

import { sleep } from '#shared/clock.ts';
import { browserClock } from './browserClock.ts';

/** Where the browser may throw, or reject. */
export const STEPS = [
  'requestPort',
  'getPorts',
  'open',
  'getReader',
  'read',
  'getWriter',
  'write',
  'cancel',
  'releaseLock',
  'close',
] as const;
export type Step = (typeof STEPS)[number];

export interface FakePort {
  readonly port: SerialPort;
  /** Packets in the order in which the driver got them. */
  readonly written: Uint8Array[];
  isOpen(): boolean;
  /** Its speed, since it was opened last. */
  baud(): number;
  deliver(...bytes: readonly number[]): void;
  /** The stream that is read fails: as after a line error, and the next one is fresh. */
  disturb(error: DOMException): void;
  /** What was open fails, and so does opening; the browser has not noticed why. */
  die(): void;
  /** And now it has: the page sees that port no more. */
  unplug(): void;
  /** Called at each reading; may throw. */
  whenRead: () => void;
  /** From now on its closing never ends. */
  jam(): void;
  /** From now on the browser passes packets on so much later, and the adapter holds them so much longer than it says. */
  dawdle(late: { readonly browserMs: number; readonly adapterMs: number }): void;
}

export interface FakeBrowser {
  failNext(step: Step, error: DOMException): void;
  /** Failures that were requested and have not happened. */
  unmet(): readonly Step[];
  /** A device that the page may see, as the browser reports it. */
  plugIn(ids?: SerialPortInfo): FakePort;
  /** For `vi.stubGlobal`. */
  readonly navigator: object;
  readonly BroadcastChannel: object;
}

export const CH340: SerialPortInfo = { usbVendorId: 0x1a86, usbProductId: 0x7523 };

export function createBrowser(): FakeBrowser {
  const failures = new Map<Step, DOMException>();
  const granted = new Set<SerialPort>();

  function trip(step: Step): void {
    const error = failures.get(step);
    failures.delete(step);
    if (error !== undefined) throw error;
  }

  const serial = Object.assign(new EventTarget(), {
    getPorts: () => attempt(() => trip('getPorts')).then(() => [...granted]),
    requestPort: () => attempt(() => trip('requestPort')).then(() => [...granted][0]),
  });
  return {
    failNext: (step, error) => failures.set(step, error),
    unmet: () => [...failures.keys()],
    plugIn(ids = CH340) {
      const made = createPort(ids, trip, () => granted.delete(made.port));
      granted.add(made.port);
      serial.dispatchEvent(new Event('connect'));
      return made;
    },
    navigator: { serial, locks: createLocks() },
    BroadcastChannel: createChannels(),
  };
}

function createPort(ids: SerialPortInfo, trip: (step: Step) => void, forget: () => void): FakePort {
  const written: Uint8Array[] = [];
  let isJammed = false;
  let late = { browserMs: 0, adapterMs: 0 };
  let heldUntilMs = 0;
  let isThere = true;
  let isDrained = true;
  let isAlive = true;
  let isOpen = false;
  let baud = NaN;
  let source: ReadableStreamDefaultController<Uint8Array> | null = null;
  let sink: WritableStreamDefaultController | null = null;
  const lost = (): DOMException => new DOMException('The device has been lost.', 'NetworkError');

  function tripRead(step: Step): void {
    if (step === 'read') fake.whenRead();
    trip(step);
  }

  function newReadable(): ReadableStream<Uint8Array> {
    const stream = new ReadableStream<Uint8Array>({
      start: (controller) => void (source = controller),
      cancel: () => trip('cancel'),
    });
    const getReader = stream.getReader.bind(stream) as () => ReadableStreamDefaultReader<Uint8Array>;
    return Object.assign(stream, { getReader: () => guarded(tripRead, 'getReader', getReader) });
  }

  function newWritable(): WritableStream<Uint8Array> {
    const stream = new WritableStream<Uint8Array>({
      start: (controller) => void (sink = controller),
      write(bytes) {
        trip('write');
        if (!isAlive) throw lost();
        written.push(bytes);
        heldUntilMs = browserClock.now() + late.adapterMs;
        isDrained = false;
      },
      async close() {
        if (late.browserMs > 0) await sleep(browserClock, late.browserMs);
        isDrained = true;
      },
    });
    const getWriter = stream.getWriter.bind(stream);
    return Object.assign(stream, { getWriter: () => guarded(trip, 'getWriter', getWriter) });
  }

  const port = {
    get connected() {
      return isThere;
    },
    readable: null as ReadableStream<Uint8Array> | null,
    writable: null as WritableStream<Uint8Array> | null,
    getInfo: () => ids,
    open: ({ baudRate }: SerialOptions) =>
      attempt(() => {
        trip('open');
        baud = baudRate;
        if (isOpen) throw new DOMException('The port is already open.', 'InvalidStateError');
        if (!isAlive) throw new DOMException('Failed to open serial port.', 'NetworkError');
        isOpen = true;
        port.readable = newReadable();
        port.writable = newWritable();
      }),
    close: () =>
      attempt(() => {
        if (isJammed) return new Promise<void>(() => undefined);
        if (port.readable?.locked || port.writable?.locked) throw new TypeError('A stream is locked.');
        isOpen = false;
        // As the browser does: what the driver still holds is thrown away.
        if (!isDrained || browserClock.now() < heldUntilMs) written.pop();
        port.readable = port.writable = source = null;
        return trip('close');
      }),
  };

  const fake: FakePort = {
    port: port as unknown as SerialPort,
    whenRead: () => undefined,
    written,
    isOpen: () => isOpen,
    baud: () => baud,
    deliver: (...bytes) => source?.enqueue(Uint8Array.from(bytes)),
    disturb(error) {
      const disturbed = source;
      port.readable = newReadable();
      disturbed?.error(error);
    },
    jam: () => void (isJammed = true),
    dawdle: (next) => void (late = next),
    unplug() {
      fake.die();
      isThere = false;
      forget();
    },
    die() {
      isAlive = false;
      port.readable = port.writable = null;
      source?.error(lost());
      sink?.error(lost());
    },
  };
  return fake;
}

/** A reader or writer whose own steps may fail too. */
function guarded<T extends { releaseLock(): void }>(trip: (step: Step) => void, step: Step, get: () => T): T {
  trip(step);
  const holder = get();
  const releaseLock = holder.releaseLock.bind(holder);
  const read = 'read' in holder ? (holder.read as () => Promise<unknown>).bind(holder) : null;
  return Object.assign(holder, {
    releaseLock() {
      releaseLock();
      trip('releaseLock');
    },
    ...(read && { read: () => attempt(() => trip('read')).then(read) }),
  });
}

async function attempt(work: () => void | Promise<void>): Promise<void> {
  await Promise.resolve();
  return work();
}

/** Exclusive locks, first come first served. */
function createLocks(): object {
  const tails = new Map<string, Promise<void>>();
  return {
    async request(name: string, { signal }: { signal: AbortSignal }, work: () => Promise<void>) {
      const before = tails.get(name) ?? Promise.resolve();
      let free = (): void => undefined;
      const mine = new Promise<void>((resolve) => (free = resolve));
      tails.set(
        name,
        before.then(() => mine),
      );
      const aborted = new Promise<never>((_, reject) => {
        signal.addEventListener('abort', () => reject(new DOMException('Too long.', 'AbortError')));
      });
      try {
        await Promise.race([before, aborted]);
        await work();
      } finally {
        free();
      }
    },
  };
}

function createChannels(): object {
  const open = new Set<Channel>();
  class Channel {
    onmessage = (): void => undefined;
    readonly name: string;
    constructor(name: string) {
      this.name = name;
      open.add(this);
    }
    postMessage(): void {
      for (const other of open)
        if (other !== this && other.name === this.name) queueMicrotask(() => other.onmessage());
    }
    close(): void {
      open.delete(this);
    }
  }
  return Channel;
}
