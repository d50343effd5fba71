// F4 of safety.md section 5: the same stream in two pieces cut anywhere, one byte at a time, and 64 KB at once gives the same
// packets and the same noise.

import { expect, test } from 'vitest';
import { createDecoder } from '../../codec/decoder.ts';
import type { ShapeRule } from '../../codec/shapes.ts';
import { createRandom } from '../../simulator/faults.ts';
import { named, seeds } from '../../testing/cases.ts';
import {
  belowFrom,
  bytesOf,
  commandSource,
  DAMAGES,
  packetsOf,
  reportSources,
  textOf,
  type Source,
} from './streams.ts';

const FILE = 'chunking.test.ts';
const STREAMS = 1_000;
const PACKETS_PER_STREAM = 9;
const CHUNK_BYTES = 64 * 1024;

const variety = belowFrom(createRandom(0));
const REPORTS = reportSources(variety);
const DIRECTIONS = [
  { direction: 'reports', sources: REPORTS, rule: REPORTS[0]!.shape },
  ...[commandSource(variety)].map((source) => ({
    direction: 'commands',
    sources: [source],
    rule: source.shape,
  })),
];

/** Every second one is damaged somewhere: whole packets alone are too easy to cut. */
function streamOf(sources: readonly Source[], seed: number): Uint8Array {
  const random = belowFrom(createRandom(seed));
  const stream = packetsOf(sources[seed % sources.length]!, PACKETS_PER_STREAM, random).join('');
  if (seed % 2 === 0) return bytesOf(stream);
  const damages = Object.values(DAMAGES);
  return bytesOf(damages[random(damages.length)]!(stream, random(stream.length), random));
}

function decode(pieces: readonly Uint8Array[], rule: ShapeRule): string {
  let said = '';
  const decoder = createDecoder((event) => {
    said += `${event.kind === 'packet' ? 'packet' : event.reason} ${textOf(event.bytes)}\n`;
  }, rule);
  for (const piece of pieces) decoder.push(piece);
  decoder.idle();
  return said;
}

function inPieces(bytes: Uint8Array, size: number): readonly Uint8Array[] {
  return Array.from({ length: Math.ceil(bytes.length / size) }, (_, index) =>
    bytes.subarray(index * size, (index + 1) * size),
  );
}

/** Where to cut so that it is not the same: 0 for byte by byte, null for nowhere. */
function tellingCut(stream: Uint8Array, rule: ShapeRule): number | null {
  const whole = decode([stream], rule);
  if (decode(inPieces(stream, 1), rule) !== whole) return 0;
  for (let at = 1; at < stream.length; at += 1)
    if (decode([stream.subarray(0, at), stream.subarray(at)], rule) !== whole) return at;
  return null;
}

test.each(DIRECTIONS)(
  'a stream of $direction says the same however it is cut',
  { timeout: 60_000 },
  async ({ direction, sources, rule }) => {
    for (const seed of seeds(STREAMS))
      await named(FILE, seed, direction, () =>
        expect(tellingCut(streamOf(sources, seed), rule), 'cut before byte').toBeNull(),
      );
  },
);

test.each(DIRECTIONS)('$direction say the same 64 KB at once', async ({ direction, sources, rule }) => {
  for (const seed of seeds(1))
    await named(FILE, seed, `${direction}, 64 KB at once`, () => {
      const streams = Array.from({ length: STREAMS }, (_, at) => streamOf(sources, seed * STREAMS + at));
      const all = bytesOf(streams.map(textOf).join(''));
      expect(decode(inPieces(all, CHUNK_BYTES), rule)).toBe(decode(inPieces(all, 1), rule));
    });
});
