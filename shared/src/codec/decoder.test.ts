// What holds for the decoder whatever comes: any chunking, any garbage, any moment of silence. Single streams with their
// expected events are vectors (vectors.test.ts); what damage costs is damage.test.ts.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { createDecoder, type DecoderEvent } from './decoder.ts';
import { fromHex, toHex } from './packet.ts';
import { COMMAND_SHAPES, REPORT_SHAPES, type ShapeRule } from './shapes.ts';

const SHAPES: readonly (readonly [string, ShapeRule])[] = [
  ['reports', REPORT_SHAPES],
  ['commands', COMMAND_SHAPES],
];

const PACKETS = [
  '55 55 02 06',
  '55 55 02 07',
  '55 55 02 0F',
  '55 55 03 08 00',
  '55 55 04 0F 4C 1D',
  '55 55 05 06 55 55 00',
  '55 55 05 08 08 01 00',
  '55 55 06 15 01 01 55 55',
  '55 55 08 03 01 E8 03 01 D0 07',
  '55 55 0E 02 01 02 55 55 02 07 03 00 04 00 05 00',
  '55 55 0E 19 05 02 00 02 E8 03 01 DC 05 02 D0 07',
  `55 55 63 15 20 ${'01 F4 01 '.repeat(32)}`,
  `55 55 FB 03 52 E8 03 ${'01 D0 07 '.repeat(82)}`,
].map(fromHex);

/** Whole and cut packets, header bytes and plain garbage in any mixture: the worst a line can say. */
const soup = fc
  .array(
    fc.oneof(
      fc.constantFrom(...PACKETS),
      fc.tuple(fc.constantFrom(...PACKETS), fc.nat(260)).map(([packet, cut]) => packet.slice(0, 1 + cut)),
      fc.array(fc.constantFrom(0x55, 0x02, 0x04, 0x05, 0x06, 0x07, 0x0f, 0x15, 0x19, 0xfd)),
      fc.uint8Array({ maxLength: 80 }),
    ),
    { maxLength: 24 },
  )
  .map((pieces) => Uint8Array.from(pieces.flatMap((piece) => Array.from(piece))));

const IDLE = 'idle';
const PAUSE = 'pause';
const feed = fc.array(
  fc.oneof({ weight: 4, arbitrary: soup }, { weight: 1, arbitrary: fc.constantFrom(IDLE, PAUSE) }),
  {
    maxLength: 6,
  },
);

function words(event: DecoderEvent): string {
  return `${event.kind === 'packet' ? 'packet' : event.reason} ${toHex(event.bytes)}`;
}

function decode(pieces: readonly (Uint8Array | typeof IDLE | typeof PAUSE)[], shape: ShapeRule): string[] {
  const events: string[] = [];
  const decoder = createDecoder((event) => events.push(words(event)), shape);
  for (const piece of pieces) {
    if (piece === IDLE) decoder.idle();
    else if (piece === PAUSE) decoder.pause();
    else decoder.push(piece);
  }
  return events;
}

/** Cuts bytes at pseudo-random places: sizes come round and round. */
function cutUp(bytes: Uint8Array, sizes: readonly number[]): Uint8Array[] {
  const pieces: Uint8Array[] = [];
  for (let at = 0, i = 0; at < bytes.length; i++) {
    const size = sizes[i % sizes.length]!;
    pieces.push(bytes.slice(at, at + size));
    at += size;
  }
  return pieces;
}

describe.each(SHAPES)('a decoder of %s', (_name, shape) => {
  test('says the same however the bytes are cut', () => {
    const sizes = fc.array(fc.integer({ min: 1, max: 40 }), { minLength: 1, maxLength: 8 });
    fc.assert(
      fc.property(feed, sizes, (pieces, cuts) => {
        const cut = pieces.flatMap(
          (piece) => (typeof piece === 'string' ? [piece] : cutUp(piece, cuts)) as typeof pieces,
        );
        expect(decode(cut, shape)).toEqual(decode(pieces, shape));
        const bytewise = pieces.flatMap(
          (piece) => (typeof piece === 'string' ? [piece] : cutUp(piece, [1])) as typeof pieces,
        );
        expect(decode(bytewise, shape)).toEqual(decode(pieces, shape));
      }),
    );
  });

  test('accounts for every byte, in order, and keeps at most 512', () => {
    fc.assert(
      fc.property(feed, (pieces) => {
        const [fed, reported]: [number[], number[]] = [[], []];
        const decoder = createDecoder((event) => reported.push(...event.bytes), shape);
        for (const piece of pieces) {
          if (piece === IDLE) {
            decoder.idle();
            expect(reported).toEqual(fed);
          } else if (piece === PAUSE) {
            decoder.pause();
          } else {
            decoder.push(piece);
            fed.push(...piece);
            expect(fed.length - reported.length).toBeLessThanOrEqual(512);
          }
        }
        decoder.idle();
        expect(reported).toEqual(fed);
      }),
    );
  });

  test('finds the packets after any garbage once the line was silent', () => {
    const known = PACKETS.filter((packet) => decode([packet, IDLE], shape)[0]?.startsWith('packet'));
    fc.assert(
      fc.property(soup, fc.array(fc.constantFrom(...known)), (garbage, packets) => {
        const events: string[] = [];
        const decoder = createDecoder((event) => events.push(words(event)), shape);
        decoder.push(garbage);
        decoder.idle();
        events.length = 0;
        for (const packet of packets) decoder.push(packet);
        decoder.idle();
        expect(events).toEqual(packets.map((packet) => `packet ${toHex(packet)}`));
      }),
    );
  });

  test('gets through the most laborious input there is', () => {
    // Header after header, each announcing a long packet that ends on a header byte and is none after all.
    const header = shape === REPORT_SHAPES ? '55 55 63 15 20' : '55 55 EF 03 4E';
    const laborious = fromHex(header.repeat(40_000));
    const events = decode([laborious, IDLE], shape);
    expect(events.every((event) => event.startsWith('garbage') || event.startsWith('truncated'))).toBe(true);
  });

  test('keeps no hold on the bytes it was given', () => {
    const packet = Uint8Array.from(PACKETS[0]!);
    const events: DecoderEvent[] = [];
    const decoder = createDecoder((event) => events.push(event), REPORT_SHAPES);
    decoder.push(packet);
    packet.fill(0);
    expect(events.map(words)).toEqual(['packet 55 55 02 06']);
  });
});

describe('a decoder', () => {
  test('forgets a half packet and unreported noise on reset', () => {
    const events: string[] = [];
    const decoder = createDecoder((event) => events.push(words(event)));
    decoder.push(fromHex('01 02 55 55 04 0F'));
    decoder.reset();
    decoder.push(fromHex('55 55 02 19'));
    decoder.idle();
    expect(events).toEqual(['packet 55 55 02 19']);
  });

  test('can be reset from inside an event', () => {
    const events: string[] = [];
    const decoder = createDecoder((event) => {
      events.push(words(event));
      decoder.reset();
    });
    for (const byte of fromHex('55 55 04 0F 4C 1D 55 55 02 19')) decoder.push(Uint8Array.of(byte));
    expect(events).toEqual(['packet 55 55 04 0F 4C 1D', 'packet 55 55 02 19']);
  });

  test('gives command number and parameters with the whole packet', () => {
    const events: DecoderEvent[] = [];
    const decoder = createDecoder((event) => events.push(event));
    decoder.push(fromHex('55 55 04 0F 4C 1D'));
    decoder.idle();
    expect(events).toEqual([
      {
        kind: 'packet',
        packet: { command: 15, params: fromHex('4C 1D') },
        bytes: fromHex('55 55 04 0F 4C 1D'),
      },
    ]);
  });
});
