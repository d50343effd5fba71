// F3 of safety.md section 5: megabytes of garbage. The decoder throws nothing, keeps next to nothing, and its work grows with
// the bytes alone: counted, because a clock would measure the machine.

import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { expect, test } from 'vitest';
import { createDecoder } from '../../codec/decoder.ts';
import { COMMAND_SHAPES, REPORT_SHAPES, type ShapeRule } from '../../codec/shapes.ts';
import { createRandom } from '../../simulator/faults.ts';
import { IS_EXHAUSTIVE, named, seeds } from '../../testing/cases.ts';
import { belowFrom, type Random } from './streams.ts';

const FILE = 'garbage.test.ts';
const CHUNK_BYTES = 64 * 1024;
const MOST_GROWN_BYTES = 64 * 1024;
const MOST_UNTOLD_BYTES = 512;
/** Headers looked up; the most laborious garbage byte by byte takes 1.6. */
const MOST_WORK_PER_BYTE = 2;

const COMMANDS_SEEN = [3, 6, 8, 15, 20, 21, 23, 25];

type ByteAt = (at: number, random: Random) => number;

/** What a line may say when no device speaks the protocol, up to what costs a decoder most. */
const GARBAGE: readonly { readonly name: string; readonly chunks: number; readonly byteAt: ByteAt }[] = [
  { name: 'random bytes', chunks: IS_EXHAUSTIVE ? 160 : 16, byteAt: (_, random) => random(256) },
  {
    name: 'bytes that are headers half the time',
    chunks: 8,
    byteAt: (_, random) => (random(2) === 0 ? 0x55 : random(256)),
  },
  {
    name: 'heads of packets without their bodies',
    chunks: 8,
    byteAt: (at, random) =>
      [0x55, 0x55, random(256), COMMANDS_SEEN[random(COMMANDS_SEEN.length)]!, random(83)][at % 5]!,
  },
  {
    name: 'long packets that turn out to be none',
    chunks: 8,
    byteAt: (at) => [0x55, 0x55, 0xef, 0x03, 0x4e][at % 5]!,
  },
];
const SHAPES = [
  { direction: 'reports', rule: REPORT_SHAPES },
  { direction: 'commands', rule: COMMAND_SHAPES },
];

/** The same rule, and how often a header was looked up in it. */
function counted(rule: ShapeRule): { readonly rule: ShapeRule; readonly lookUps: () => number } {
  let lookUps = 0;
  const counting = {
    ...rule,
    get lengths() {
      lookUps += 1;
      return rule.lengths;
    },
  };
  return { rule: counting, lookUps: () => lookUps };
}

setFlagsFromString('--expose-gc');
const collect = runInNewContext('gc') as () => void;

function memoryInUse(): number {
  collect();
  const { heapUsed, arrayBuffers } = process.memoryUsage();
  return heapUsed + arrayBuffers;
}

/** All that is fed is reported again, in pieces: what is not reported yet is what the decoder holds. */
function feed(byteAt: ByteAt, rule: ShapeRule, chunks: number, pieceBytes: number, seed: number): void {
  const random = belowFrom(createRandom(seed));
  const counting = counted(rule);
  let [fed, reportedBytes, mostUnreported] = [0, 0, 0];
  const decoder = createDecoder(({ bytes }) => (reportedBytes += bytes.length), counting.rule);
  const chunk = new Uint8Array(CHUNK_BYTES);
  const inUse: number[] = [];
  for (let quarter = 0; quarter < 4; quarter += 1) {
    for (let count = 0; count < chunks / 4; count += 1) {
      for (let at = 0; at < CHUNK_BYTES; at += 1) chunk[at] = byteAt(at, random);
      for (let at = 0; at < CHUNK_BYTES; at += pieceBytes) {
        decoder.push(chunk.subarray(at, at + pieceBytes));
        fed += Math.min(pieceBytes, CHUNK_BYTES - at);
        mostUnreported = Math.max(mostUnreported, fed - reportedBytes);
      }
    }
    inUse.push(memoryInUse());
  }
  decoder.idle();
  expect(reportedBytes).toBe(fed);
  expect(mostUnreported).toBeLessThanOrEqual(MOST_UNTOLD_BYTES);
  expect(counting.lookUps() / fed).toBeLessThanOrEqual(MOST_WORK_PER_BYTE);
  // A decoder that kept what it was fed would grow in each quarter; what the runner itself holds comes and goes.
  const grown = inUse.slice(1).map((bytes, quarter) => bytes - inUse[quarter]!);
  expect(Math.min(...grown)).toBeLessThanOrEqual(MOST_GROWN_BYTES);
}

test.each(SHAPES.flatMap((shape) => GARBAGE.map((garbage) => ({ ...shape, ...garbage }))))(
  'a decoder of $direction gets through $name',
  { timeout: 60_000 },
  async ({ rule, name, byteAt, chunks }) => {
    for (const seed of seeds(1)) {
      await named(FILE, seed, name, () => feed(byteAt, rule, chunks, CHUNK_BYTES, seed));
      await named(FILE, seed, `${name}, byte by byte`, () => feed(byteAt, rule, 4, 1, seed));
    }
  },
);
