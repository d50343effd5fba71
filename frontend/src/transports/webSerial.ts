// A board on this computer's serial port, through the browser's Web Serial. Knows in which order a port is claimed, found, opened
// and given back; no packets.

import { sleep } from '#shared/clock.ts';
import { LinkError } from '#shared/session/linkError.ts';
import type { ByteChannel, OpenOptions } from '#shared/session/byteChannel.ts';
import { browserClock } from './browserClock.ts';
import { openPort, type PortConnection } from './portConnection.ts';
import { createPortFinder } from './portFinder.ts';
import { createPortLock } from './portLock.ts';
import { portLabel } from './serialPorts.ts';

/** A robot that does not let itself be stopped in that time is past helping; the other tab shall get it. */
const HALT_WITHIN_MS = 2000;

export function createWebSerialChannel(chosen: SerialPort): ByteChannel {
  const label = portLabel(chosen);
  const finder = createPortFinder(chosen);
  const lock = createPortLock(`servodeck port ${label}`);
  const inTurn = createQueue();
  let connection: PortConnection | null = null;
  /** A device that is plugged in says nothing of the other tab. */
  let isElsewhere = false;

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
    const received = (bytes: Uint8Array): void => channel.events?.received(bytes);
    try {
      connection = await openPort(await finder.find(), { received, lost: lose });
    } catch (error) {
      lock.release();
      throw error;
    }
  }

  const mayBeBack = (): void => channel.events?.available();

  function awaitDevice(): void {
    if (!isElsewhere) navigator.serial.addEventListener('connect', mayBeBack);
  }

  const stopAwaiting = (): void => navigator.serial.removeEventListener('connect', mayBeBack);

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
    finder.wentAway();
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
    label,
    longestPacket: Infinity,
    events: null,
    open(options) {
      stopAwaiting();
      return inTurn(() => open(options));
    },
    async write(packet) {
      if (connection === null) throw new LinkError('closed', 'the port is not open');
      await connection.send(packet);
    },
    close(lastPacket) {
      stopAwaiting();
      const current = connection;
      const leaving = lastPacket && current?.sendAtOnce(lastPacket);
      if (leaving === undefined) return inTurn(() => letGo());
      finder.wentAway();
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
