// F2 of safety.md section 5: one byte of a stream is lost, doubled, changed, or one comes in between. What that costs: good
// packets lost, and damaged ones believed. The figures stand in shared/protocol/README.md.

import { describe, expect, test } from 'vitest';
import { createDecoder } from '../../codec/decoder.ts';
import type { ShapeRule } from '../../codec/shapes.ts';
import { createRandom } from '../../simulator/faults.ts';
import { named, replay, seeds } from '../../testing/cases.ts';
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

const FILE = 'damage.test.ts';
/** Per kind of damage and source. */
const CASES = 20_000;
const PACKETS_PER_STREAM = 9;
const DAMAGED_AND_NEIGHBOUR = 2;
/** Fewer would not tell the share. */
const SHARE_SAMPLE = 2_000;
const MOST_WRONG_SHARE = 0.01;

const variety = belowFrom(createRandom(0));
const SOURCES = [...reportSources(variety), commandSource(variety)];

type Kind = keyof typeof DAMAGES;
interface Cost {
  /** Sent packets that are missing, the damaged one included. */
  readonly lost: number;
  /** Packets that were not sent. */
  readonly believed: number;
}

const believedOne = ({ believed }: Cost): boolean => believed > 0;
const lostMany = ({ lost }: Cost): boolean => lost > DAMAGED_AND_NEIGHBOUR;
/** What may happen to one stream in a hundred. A changed value shows nowhere: there is no checksum. */
const WRONG: Readonly<Record<Kind, (cost: Cost) => boolean>> = {
  drop: believedOne,
  double: believedOne,
  insert: believedOne,
  flip: lostMany,
};

function decodeAll(stream: string, shape: ShapeRule): string[] {
  const packets: string[] = [];
  const decoder = createDecoder((event) => {
    if (event.kind === 'packet') packets.push(textOf(event.bytes));
  }, shape);
  decoder.push(bytesOf(stream));
  decoder.idle();
  return packets;
}

/** Without what both begin and end with: the damage is in the middle. */
function differing(
  sent: readonly string[],
  got: readonly string[],
): readonly [sent: readonly string[], got: readonly string[]] {
  let [from, sentTo, gotTo] = [0, sent.length, got.length];
  while (from < Math.min(sentTo, gotTo) && sent[from] === got[from]) from += 1;
  for (; sentTo > from && gotTo > from && sent[sentTo - 1] === got[gotTo - 1]; gotTo -= 1) sentTo -= 1;
  return [sent.slice(from, sentTo), got.slice(from, gotTo)];
}

/** Length of the longest common subsequence: the sent packets that arrived, in order. */
function arrived(sent: readonly string[], got: readonly string[]): number {
  let previous = new Array<number>(got.length + 1).fill(0);
  for (const packet of sent) {
    const row = [0];
    got.forEach((other, i) => {
      row.push(packet === other ? previous[i]! + 1 : Math.max(previous[i + 1]!, row[i]!));
    });
    previous = row;
  }
  return previous[got.length]!;
}

function costOf(source: Source, kind: Kind, seed: number): Cost {
  const random = belowFrom(createRandom(seed));
  const packets = packetsOf(source, PACKETS_PER_STREAM, random);
  const stream = packets.join('');
  const damaged = DAMAGES[kind](stream, random(stream.length), random);
  const [sent, got] = differing(packets, decodeAll(damaged, source.shape));
  const good = arrived(sent, got);
  return { lost: sent.length - good, believed: got.length - good };
}

/** Only a wrong packet that is believed may swallow more than one good one. */
function refuseSilentLoss(cost: Cost): void {
  if (lostMany(cost) && !believedOne(cost)) throw new Error(`${cost.lost} packets lost`);
}

describe.each(SOURCES)('one damaged byte in $name', { timeout: 120_000 }, (source) => {
  test.each(Object.keys(DAMAGES) as Kind[])('%s costs one good neighbour at most', async (kind) => {
    const wrong: number[] = [];
    for (const seed of seeds(CASES, SHARE_SAMPLE))
      await named(FILE, seed, `${kind} in ${source.name}`, () => {
        const cost = costOf(source, kind, seed);
        refuseSilentLoss(cost);
        if (WRONG[kind](cost)) wrong.push(seed);
      });
    const first = wrong[0] ?? 0;
    expect(
      wrong.length / seeds(CASES, SHARE_SAMPLE).length,
      `wrong from seed ${first} on\nreplay: ${replay(FILE, first)}`,
    ).toBeLessThanOrEqual(MOST_WRONG_SHARE);
  });
});
