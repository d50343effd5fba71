// One open HID device, from opening to closing: one packet a report, one report at a time, no closer than the UART behind it or 20 ms;
// reports in, cut to their packet. Knows no packet beyond its length, and not which device is the right one.

import { sleep } from '#shared/clock.ts';
import { wireMs } from '#shared/codec/packet.ts';
import { reportOf, splitReport } from '#shared/robot/hidReports.ts';
import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';
import timings from '../../../../shared/protocol/timings.json' with { type: 'json' };
import { browserClock } from './browserClock.ts';
import { createConnection, settled, within, type Connection, type ConnectionEvents } from './connection.ts';
import { nameOf } from './serialPorts.ts';

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
  let leaving: Promise<void> = Promise.resolve();

  function heard({ data }: HIDInputReportEvent): void {
    const { packet, rest } = splitReport(new Uint8Array(data.buffer, data.byteOffset, data.byteLength));
    if (packet.length > 0) events.received(packet, true);
    if (rest.length > 0) events.unread(rest);
  }

  function unplugged(event: HIDConnectionEvent): void {
    if (event.device === device) connection.lose();
  }

  device.addEventListener('inputreport', heard);
  navigator.hid.addEventListener('disconnect', unplugged);

  /** Resolves when the UART behind the cable has had the time for it, too. */
  async function send(packet: Uint8Array): Promise<void> {
    const startMs = browserClock.now();
    await within(sendTimeoutMs, device.sendReport(REPORT_ID, reportOf(packet)));
    await sleep(
      browserClock,
      Math.max(0, startMs + Math.max(wireMs(packet.length), shortestMs) - browserClock.now()),
    );
  }

  const connection = createConnection(
    {
      writeOut: (packet) => (leaving = send(packet)),
      sendAtOnce: (packet) => (leaving = settled(Promise.all([leaving, send(packet)]))),
      async end(isGone) {
        device.removeEventListener('inputreport', heard);
        navigator.hid.removeEventListener('disconnect', unplugged);
        // What a device was given since it went never settles.
        if (!isGone) await settled(leaving);
        await settled(within(CLOSE_WITHIN_MS, device.close()));
      },
    },
    events,
  );
  return connection;
}
