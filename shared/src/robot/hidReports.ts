// Packets in USB HID reports: one packet a report, zero-padded; of a report from the board the packet at its beginning. Knows bytes
// only, no device. Its twin is backend/servodeck/port/hid_reports.py; shared/protocol/vectors/hid.json holds both.

import timings from '../../protocol/timings.json' with { type: 'json' };
import { HEADER, MIN_LENGTH } from '../codec/packet.ts';

export const REPORT_BYTES = timings.hid.reportBytes;

/** The report that carries it. Throws RangeError where it does not fit. */
export function reportOf(packet: Uint8Array): Uint8Array<ArrayBuffer> {
  if (packet.length > REPORT_BYTES)
    throw new RangeError(`${packet.length} bytes do not fit into a report of ${REPORT_BYTES}`);
  const report = new Uint8Array(REPORT_BYTES);
  report.set(packet);
  return report;
}

export interface SplitReport {
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
