// A board on its own USB cable, through the browser's WebHID: which devices a person has chosen, and a channel over one: one packet a
// report, one report at a time, no closer than the UART behind it or 20 ms. Knows no packet beyond its length.

import type { ByteChannel } from '#shared/robot/byteChannel.ts';
import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';
import USB from '../../../../shared/protocol/usb.json' with { type: 'json' };
import type { Withheld } from '#shared/robot/state.ts';
import { sleep } from '#shared/clock.ts';
import { wireMs, HEADER, MIN_LENGTH } from '#shared/codec/packet.ts';
import { createDeviceFinder, nameOf } from './browserDevices.ts';
import { createTabChannel } from './tabChannel.ts';
import { browserClock } from './browserClock.ts';
import { createConnection, settled, within, type Connection, type ConnectionEvents } from './connection.ts';
import timings from '../../../../shared/protocol/timings.json' with { type: 'json' };

export const REPORT_BYTES = timings.hid.reportBytes;

/**
 * The report that carries the packet, padded with zeros. Throws RangeError where it does not fit. Its twin is
 * backend/servodeck/port/hid_reports.py; shared/protocol/vectors/hid.json holds both.
 */
export function reportOf(packet: Uint8Array): Uint8Array<ArrayBuffer> {
  if (packet.length > REPORT_BYTES)
    throw new RangeError(`${packet.length} bytes do not fit into a report of ${REPORT_BYTES}`);
  const report = new Uint8Array(REPORT_BYTES);
  report.set(packet);
  return report;
}

interface SplitReport {
  /** At the beginning; empty where none is. */
  readonly packet: Uint8Array;
  /** What else is in it, without its padding. */
  readonly rest: Uint8Array;
}

/** A second packet in the same report is not believed: it may be left over from the report before. */
export function splitReport(report: Uint8Array): SplitReport {
  const [first, second, length = 0] = report;
  const size = length + 2;
  const isWhole =
    first === HEADER &&
    second === HEADER &&
    length >= MIN_LENGTH &&
    size <= Math.min(report.length, REPORT_BYTES);
  const end = isWhole ? size : 0;
  const stop = report.findLastIndex((byte) => byte !== 0) + 1;
  return { packet: report.subarray(0, end), rest: report.subarray(end, Math.max(end, stop)) };
}

/** Why WebHID cannot be used here. An insecure address hides it in every browser. */
type HidObstacle = Extract<LinkErrorCode, 'insecureAddress' | 'unsupported'>;

export interface GrantedBoard {
  readonly board: HIDDevice;
  /** The channel's own name of it. */
  readonly label: string;
}

export interface HidHere {
  readonly obstacle: HidObstacle | null;
  /** Chosen before and plugged in; opening them needs no chooser. */
  readonly granted: readonly GrantedBoard[];
}

const { vendorId, productId, names: NAMES } = USB.hid;
/** Commands of their own do these on HID, and only other programs document those (docs/adr/0028). */
export const HID_WITHHELD: readonly Withheld[] = ['download', 'erase'];

export async function lookForHid(): Promise<HidHere> {
  if (!window.isSecureContext) return { obstacle: 'insecureAddress', granted: [] };
  if (!('hid' in navigator)) return { obstacle: 'unsupported', granted: [] };
  const boards = await navigator.hid.getDevices().catch(() => []);
  const likelyFirst = boards.toSorted((one, other) => Number(isLikely(other)) - Number(isLikely(one)));
  return { obstacle: null, granted: likelyFirst.map((board) => ({ board, label: boardLabel(board) })) };
}

/**
 * Opens the browser's chooser; needs a click. `all`: with every HID device, for a board that calls itself otherwise. Rejects with
 * `notChosen` when it is closed without a choice.
 */
export async function chooseBoard(all = false): Promise<HIDDevice> {
  try {
    const [board] = await navigator.hid.requestDevice({ filters: all ? [] : [{ vendorId, productId }] });
    if (board !== undefined) return board;
  } catch (error) {
    const code = ['NotFoundError', 'AbortError'].includes(nameOf(error)) ? 'notChosen' : 'portDenied';
    throw new LinkError(code, 'no device was chosen', { cause: error });
  }
  throw new LinkError('notChosen', 'no device was chosen');
}

export function createWebHidChannel(chosen: HIDDevice): ByteChannel {
  const label = boardLabel(chosen);
  const finder = createDeviceFinder(chosen, {
    list: () => navigator.hid.getDevices(),
    isGone: () => false,
    isSameKind: (one, other) => kindOf(one) === kindOf(other),
  });
  return createTabChannel({
    label,
    longestPacket: REPORT_BYTES,
    inReports: true,
    lockName: `servodeck board ${kindOf(chosen)}`,
    connect: async (events) => openBoard(await finder.find(), events),
    wentAway: finder.wentAway,
    watch(mayBeBack) {
      navigator.hid.addEventListener('connect', mayBeBack);
      return () => navigator.hid.removeEventListener('connect', mayBeBack);
    },
  });
}

const isLikely = ({ productName }: HIDDevice): boolean =>
  NAMES.some((name) => productName.toLowerCase().includes(name));

/** The browser reports no more of a device, so two boards of a kind bear one name. */
const kindOf = ({ vendorId, productId, productName }: HIDDevice): string =>
  `${hex(vendorId)}:${hex(productId)} ${productName}`;

const hex = (id: number): string => id.toString(16).padStart(4, '0');

function boardLabel(board: HIDDevice): string {
  return board.productName === ''
    ? `HID device (id ${hex(board.vendorId)}:${hex(board.productId)})`
    : board.productName;
}

const { shortestMs, sendTimeoutMs } = timings.hid;
/** The boards number no reports. */
const REPORT_ID = 0;
/** A device that does not let itself be closed is given up, so that another attempt can begin. */
const CLOSE_WITHIN_MS = 250;

async function openBoard(device: HIDDevice, events: ConnectionEvents): Promise<Connection> {
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
  // Chromium says so whatever the reason: on Linux nearly always the rights to the device.
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
