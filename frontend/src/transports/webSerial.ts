// A board on this computer's serial port, through the browser's Web Serial. Knows in which order a port is claimed, found, opened
// and given back; no packets.

import { sleep } from '#shared/clock.ts';
import { LinkError } from '#shared/session/linkError.ts';
import type { Transport, TransportEvents } from '#shared/session/transport.ts';
import { browserClock } from './browserClock.ts';
import { openPort, type PortConnection } from './portConnection.ts';
import { createPortFinder } from './portFinder.ts';
import { createPortLock } from './portLock.ts';
import { portLabel } from './serialPorts.ts';

/** A robot that does not let itself be stopped in that time is past helping; the other tab shall get it. */
const HALT_WITHIN_MS = 2000;

export function createWebSerialTransport(
  chosen: SerialPort,
  /** Stops the robot before another tab gets the port. */
  halt: () => Promise<void> = () => Promise.resolve(),
): Transport {
  const label = portLabel(chosen);
  const finder = createPortFinder(chosen);
  const lock = createPortLock(`servodeck port ${label}`);
  const inTurn = createQueue();
  let connection: PortConnection | null = null;
  let events: TransportEvents | null = null;
  let isElsewhere = false;

  async function open(next: TransportEvents): Promise<void> {
    await letGo();
    await claim();
    try {
      connection = await openPort(await finder.find(), { received: next.received, lost: lose });
      events = next;
    } catch (error) {
      lock.release();
      throw error;
    }
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
    const told = events;
    events = null;
    finder.wentAway();
    told?.lost(error);
  }

  async function moveAway(): Promise<void> {
    if (events === null) return;
    // A link that fails meanwhile has nothing left to stop.
    await Promise.race([halt(), sleep(browserClock, HALT_WITHIN_MS)]).catch(() => undefined);
    await letGo();
    isElsewhere = true;
    tellLost(new LinkError('movedAway', 'another tab has it'));
  }

  return {
    kind: 'webSerial',
    isSimulated: false,
    label,
    open: (next) => inTurn(() => open(next)),
    async send(packet) {
      if (connection === null) throw new LinkError('closed', 'the port is not open');
      await connection.send(packet);
    },
    leave(lastPacket) {
      const current = connection;
      if (current === null) return;
      void current.sendAtOnce(lastPacket).then(() => letGo(current));
      tellLost(new LinkError('lost', 'the page was left'));
    },
    takeOver: lock.askForIt,
    whenAvailable(notify) {
      // A device that is plugged in says nothing of the other tab.
      if (isElsewhere) return () => undefined;
      navigator.serial.addEventListener('connect', notify);
      return () => {
        navigator.serial.removeEventListener('connect', notify);
      };
    },
    close() {
      events = null;
      return inTurn(() => letGo());
    },
  };
}

/** One after the other, whatever became of the one before: a port that is being opened cannot be closed yet. */
function createQueue(): (work: () => Promise<void>) => Promise<void> {
  let last: Promise<void> = Promise.resolve();
  return (work) => (last = last.then(work, work));
}
