// F2 of safety.md section 5 at the other end of the wire: the simulated boards' parsers. They have no checksum and no
// time-out, so one damaged byte may cost every packet behind it; yet they never throw, never hand over more than they hold,
// and what the boards' documents say frees them does.

import { describe, expect, test } from 'vitest';
import { createLearmParser } from '../../simulator/learm/engine.ts';
import { createParser } from '../../simulator/dispatch.ts';
import { createRandom } from '../../simulator/faults.ts';
import { named, seeds } from '../../testing/cases.ts';
import { belowFrom, bytesOf, commandSource, DAMAGES, packetsOf, textOf, type Random } from './streams.ts';

const FILE = 'boardParser.test.ts';
const CASES = 20_000;
const PACKETS_PER_STREAM = 5;
const HEADER_BYTES = 2;

interface Parser {
  readonly name: string;
  /** Gives what it takes for packets. */
  readonly create: (heard: (packet: string) => void) => (byte: number) => void;
  /** After this it hunts for a header again, whatever came before. */
  readonly filler: string;
  readonly mostBytes: number;
}

const PARSERS: readonly Parser[] = [
  {
    name: 'the open firmware',
    // An index that wrapped has written over the header (S3), at which no handler looks.
    create: (heard) => createParser((packet) => heard(textOf(packet.subarray(HEADER_BYTES)))),
    filler: '\xfd'.repeat(508), // S7
    mostBytes: 253,
  },
  {
    name: 'LeArm',
    create: (heard) =>
      createLearmParser({
        complete: (command, params) => heard(String.fromCharCode(command) + textOf(params)),
        overrun: () => undefined,
      }),
    filler: '\0'.repeat(63), // its buffer, and the bytes before it
    mostBytes: 61,
  },
];
const STOP = '\x55\x55\x02\x07';

const source = commandSource(belowFrom(createRandom(0)));
type Kind = keyof typeof DAMAGES;

function damagedStream(kind: Kind, random: Random): string {
  const stream = packetsOf(source, PACKETS_PER_STREAM, random).join('');
  return DAMAGES[kind](stream, random(stream.length), random);
}

/** What it hears of a stop that comes after the noise and the filler. */
function heardAfter({ create, filler, mostBytes }: Parser, noise: string): readonly string[] {
  const heard: string[] = [];
  const take = create((packet) => {
    if (packet.length > mostBytes) throw new RangeError(`a packet of ${packet.length} bytes`);
    heard.push(packet);
  });
  bytesOf(noise + filler).forEach(take);
  heard.length = 0;
  bytesOf(STOP).forEach(take);
  return heard;
}

describe.each(PARSERS)('the parser of $name', (parser) => {
  const untouched = heardAfter(parser, '');

  test.each(Object.keys(DAMAGES) as Kind[])(
    'is free again after its filler: %s',
    { timeout: 60_000 },
    async (kind) => {
      for (const seed of seeds(CASES))
        await named(FILE, seed, kind, () => {
          const noise = damagedStream(kind, belowFrom(createRandom(seed)));
          if (heardAfter(parser, noise).join() !== untouched.join())
            throw new Error('it does not hear the stop');
        });
      expect(untouched).toHaveLength(1);
    },
  );
});
