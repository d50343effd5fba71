// Packets in HID reports: the shared cases, and that a cable with reports says what a serial line says.

import fc from 'fast-check';
import { expect, test } from 'vitest';
import cases from '../../../../shared/protocol/vectors/hid.json' with { type: 'json' };
import vectors from '../../../../shared/protocol/vectors/reports.json' with { type: 'json' };
import { createDecoder, type DecoderEvent } from '#shared/codec/decoder.ts';
import { fromHex } from '#shared/codec/packet.ts';
import { REPORT_BYTES, reportOf, splitReport } from './webHid.ts';

const PACKETS = vectors.map(({ hex }) => fromHex(hex)).filter(({ length }) => length <= REPORT_BYTES);

test.each(cases)('$name', ({ report, packet, rest }) => {
  const split = splitReport(fromHex(report));
  expect([split.packet, split.rest]).toEqual([fromHex(packet), fromHex(rest)]);
});

test('a packet is padded to a whole report, and one that is longer is never split', () => {
  expect(reportOf(fromHex('55 55 02 07'))).toEqual(
    Uint8Array.from([0x55, 0x55, 2, 7, ...Array<number>(60).fill(0)]),
  );
  expect(() => reportOf(new Uint8Array(65))).toThrow(RangeError);
});

test('any chunking and padding gives the packets that a serial line gives', () => {
  fc.assert(
    fc.property(
      fc.array(fc.tuple(fc.constantFrom(...PACKETS), fc.nat(REPORT_BYTES), fc.integer({ min: 1, max: 64 }))),
      (said) => {
        const serial = decoded((decoder) => {
          for (const [packet, , pieceBytes] of said) {
            for (let at = 0; at < packet.length; at += pieceBytes)
              decoder.push(packet.subarray(at, at + pieceBytes));
            decoder.idle();
          }
        });
        const hid = decoded((decoder) => {
          for (const [packet, padding] of said) {
            const report = new Uint8Array(Math.min(packet.length + padding, REPORT_BYTES));
            report.set(packet);
            const split = splitReport(report);
            expect(split.rest).toHaveLength(0);
            decoder.push(split.packet);
            decoder.pause();
          }
        });
        expect(hid).toEqual(serial);
      },
    ),
  );
});

test('no report is an error, and none of its bytes is lost but the padding', () => {
  fc.assert(
    fc.property(fc.uint8Array({ maxLength: REPORT_BYTES }), (report) => {
      const { packet, rest } = splitReport(report);
      const unpadded = report.subarray(0, report.findLastIndex((byte) => byte !== 0) + 1);
      const bytes = [...packet, ...rest];
      expect(bytes.slice(0, unpadded.length)).toEqual([...unpadded]);
      expect(bytes.slice(unpadded.length).every((byte) => byte === 0)).toBe(true);
    }),
  );
});

type Decoder = ReturnType<typeof createDecoder>;

function decoded(feed: (decoder: Decoder) => void): readonly DecoderEvent[] {
  const events: DecoderEvent[] = [];
  feed(createDecoder((event) => events.push(event)));
  return events;
}
