// A device that one tab of this browser has at a time, as a byte channel: takes the device's Web Lock, lets go of it for the tab that requests it,
// opens and closes one after the other. Knows no kind of device and no packets.

import { sleep } from '#shared/clock.ts';
import type { ByteChannel, OpenOptions } from '#shared/robot/byteChannel.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import { browserClock } from './browserClock.ts';
import type { Connection, ConnectionEvents } from './connection.ts';

interface TabDevice extends Pick<ByteChannel, 'label' | 'longestPacket' | 'inReports'> {
  /** The same in all tabs. */
  readonly lockName: string;
  /** Rejects with a LinkError, in bounded time. */
  connect(events: ConnectionEvents): Promise<Connection>;
  /** The device has just gone, perhaps. */
  wentAway?(): void;
  /** Calls back when the device may be there again, until the returned function is called. */
  watch(mayBeBack: () => void): () => void;
}

/** A robot that does not let itself be stopped in that time is past helping; the other tab shall get it. */
const HALT_WITHIN_MS = 2000;

export function createTabChannel(device: TabDevice): ByteChannel {
  const lock = createPortLock(device.lockName);
  const inTurn = createQueue();
  let connection: Connection | null = null;
  /** A device that is plugged in says nothing of the other tab. */
  let isElsewhere = false;
  let stopAwaiting = (): void => undefined;

  async function open({ takesOver = false }: OpenOptions = {}): Promise<void> {
    await letGo();
    try {
      if (takesOver) await lock.askForIt();
      await claim();
      await connect();
    } catch (error) {
      awaitDevice();
      throw error;
    }
  }

  async function connect(): Promise<void> {
    const events: ConnectionEvents = {
      received: (bytes, whole) => channel.events?.received(bytes, whole),
      unread: (bytes) => channel.events?.unread(bytes),
      lost: lose,
    };
    try {
      connection = await device.connect(events);
    } catch (error) {
      lock.release();
      throw error;
    }
  }

  function awaitDevice(): void {
    stopAwaiting();
    stopAwaiting = isElsewhere ? () => undefined : device.watch(() => channel.events?.available());
  }

  async function claim(): Promise<void> {
    isElsewhere = true;
    await lock.take(() => void moveAway());
    isElsewhere = false;
  }

  /** The lock last: the port is free for the tab that gets it. */
  async function letGo(ending = connection): Promise<void> {
    await ending?.close();
    if (connection !== ending) return;
    connection = null;
    lock.release();
  }

  function lose(error: LinkError): void {
    void letGo();
    tellLost(error);
  }

  function tellLost(error: LinkError): void {
    device.wentAway?.();
    awaitDevice();
    channel.events?.lost(error);
  }

  async function moveAway(): Promise<void> {
    const moved = connection;
    if (moved === null) return;
    // A link that fails meanwhile has nothing left to stop.
    await Promise.race([channel.events?.claimed(), sleep(browserClock, HALT_WITHIN_MS)]).catch(
      () => undefined,
    );
    if (connection !== moved) return;
    await letGo();
    isElsewhere = true;
    tellLost(new LinkError('movedAway', 'another tab has it'));
  }

  const channel: ByteChannel = {
    label: device.label,
    longestPacket: device.longestPacket,
    inReports: device.inReports ?? false,
    events: null,
    open(options) {
      stopAwaiting();
      return inTurn(() => open(options));
    },
    async write(packet) {
      if (connection === null) throw new LinkError('closed', 'the device is not open');
      await connection.send(packet);
    },
    close(lastPacket) {
      stopAwaiting();
      const current = connection;
      const leaving = lastPacket && current?.sendAtOnce(lastPacket);
      if (leaving === undefined) return inTurn(() => letGo());
      device.wentAway?.();
      awaitDevice();
      return leaving.then(() => letGo(current));
    },
  };
  return channel;
}

/** One after the other, whatever became of the one before: a port that is being opened cannot be closed yet. */
function createQueue(): (work: () => Promise<void>) => Promise<void> {
  let last: Promise<void> = Promise.resolve();
  return (work) => (last = last.then(work, work));
}

interface PortLock {
  /** `requested` is called when another tab wants it. Rejects with `heldElsewhere`. */
  take(requested: () => void): Promise<void>;
  /** Harmless when it is not held. */
  release(): void;
  /** Has the tab that holds it let go, and waits for that. Rejects with `heldElsewhere` when it does not. */
  askForIt(): Promise<void>;
}

/** A page that is being reloaded or has crashed, and a port that is being closed, let go a moment after the next request. */
const GRANT_WITHIN_MS = 1500;
/** The other tab stops the robot and closes the port first: 2,000 and 1,250 ms at worst. */
const YIELD_WITHIN_MS = 3500;

function createPortLock(name: string): PortLock {
  let release = (): void => undefined;

  return {
    async take(requested) {
      const free = await hold(name, GRANT_WITHIN_MS);
      const channel = new BroadcastChannel(name);
      channel.onmessage = requested;
      release = () => {
        channel.close();
        free();
      };
    },
    release: () => release(),
    async askForIt() {
      const channel = new BroadcastChannel(name);
      channel.postMessage('let go');
      const free = await hold(name, YIELD_WITHIN_MS);
      channel.close();
      free();
    },
  };
}

/** Resolves, once the lock is ours, with what frees it. */
function hold(name: string, withinMs: number): Promise<() => void> {
  const patience = new AbortController();
  const calm = browserClock.after(withinMs, () => patience.abort());
  return new Promise((resolve, reject) => {
    const untilFreed = (): Promise<void> =>
      new Promise((free) => {
        calm();
        resolve(() => free());
      });
    navigator.locks.request(name, { signal: patience.signal }, untilFreed).catch((error: unknown) => {
      reject(new LinkError('heldElsewhere', 'another tab holds the port', { cause: error }));
    });
  });
}
