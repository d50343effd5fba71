// One open HID device, from opening to closing: one packet a report, one report at a time, no closer than the UART behind it or 20 ms;
// reports in, cut to their packet. Knows no packet beyond its length, and not which device is the right one.

import { sleep } from '#shared/clock.ts';
import { wireMs } from '#shared/codec/packet.ts';
import { reportOf, splitReport } from '#shared/robot/hidReports.ts';
import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';
import timings from '../../../../shared/protocol/timings.json' with { type: 'json' };
import { browserClock } from './browserClock.ts';
import { nameOf } from './serialPorts.ts';
import type { Connection, ConnectionEvents } from './tabChannel.ts';

const { shortestMs, sendTimeoutMs } = timings.hid;
/** The boards number no reports. */
const REPORT_ID = 0;
/** A device that does not let itself be closed is given up, so that another attempt can begin. */
const CLOSE_WITHIN_MS = 250;

export async function openBoard(device: HIDDevice, events: ConnectionEvents): Promise<Connection> {
  try {
    // Since it was unplugged it says that it is open, and is not.
    if (device.opened) await within(CLOSE_WITHIN_MS, device.close());
    await within(sendTimeoutMs, device.open());
  } catch (error) {
    throw new LinkError(openFailure(error), 'the device could not be opened', { cause: error });
  }
  return begin(device, events);
}

function openFailure(error: unknown): LinkErrorCode {
  const name = nameOf(error);
  // Chromium says so whatever kept it: on Linux nearly always the rights to the device.
  if (name === 'NotAllowedError' || name === 'SecurityError') return 'hidDenied';
  return name === 'NotFoundError' ? 'portMissing' : 'portBusy';
}

function begin(device: HIDDevice, events: ConnectionEvents): Connection {
  let closing: Promise<void> | null = null;
  let leaving: Promise<void> = Promise.resolve();
  let failSending = (_error: LinkError): void => undefined;

  function heard({ data }: HIDInputReportEvent): void {
    const { packet, rest } = splitReport(new Uint8Array(data.buffer, data.byteOffset, data.byteLength));
    if (packet.length > 0) events.received(packet, true);
    if (rest.length > 0) events.unread(rest);
  }

  function unplugged(event: HIDConnectionEvent): void {
    if (event.device === device) lose();
  }

  device.addEventListener('inputreport', heard);
  navigator.hid.addEventListener('disconnect', unplugged);

  /** Tells first: a device that is gone may take its time to close. */
  function lose(cause?: unknown): void {
    if (closing !== null) return;
    // What it was given since will never settle.
    leaving = Promise.resolve();
    const error = gone(cause);
    void close();
    events.lost(error);
  }

  function close(): Promise<void> {
    closing ??= end();
    failSending(gone());
    return closing;
  }

  async function end(): Promise<void> {
    device.removeEventListener('inputreport', heard);
    navigator.hid.removeEventListener('disconnect', unplugged);
    await settled(leaving);
    await settled(within(CLOSE_WITHIN_MS, device.close()));
  }

  /** Resolves when the UART behind the cable has had the time for it, too. */
  async function writeOut(packet: Uint8Array): Promise<void> {
    const startMs = browserClock.now();
    await within(sendTimeoutMs, device.sendReport(REPORT_ID, reportOf(packet)));
    await sleep(
      browserClock,
      Math.max(0, startMs + Math.max(wireMs(packet.length), shortestMs) - browserClock.now()),
    );
  }

  return {
    send(packet) {
      if (closing !== null) return Promise.reject(gone());
      return new Promise((resolve, reject) => {
        failSending = reject;
        leaving = writeOut(packet);
        leaving.then(resolve, lose);
      });
    },
    sendAtOnce(packet) {
      leaving = settled(Promise.all([leaving, writeOut(packet)]));
      return leaving;
    },
    close,
  };
}

/** `sendReport` of a device that went never settles, and so may others. */
function within<T>(ms: number, work: Promise<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    const calm = browserClock.after(ms, () => reject(new LinkError('lost', 'the device takes nothing')));
    work.then(resolve, reject).finally(calm);
  });
}

function gone(cause?: unknown): LinkError {
  return new LinkError('lost', 'the device is gone', { cause });
}

/** What fails here was about to end anyway. */
async function settled(work: Promise<unknown>): Promise<void> {
  await work.catch(() => undefined);
}
