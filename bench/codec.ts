// The codec's throughput, beside the naive codec on the same bytes. A line carries 960 bytes a second, so either is fast
// enough for one board; what counts is what is left for everything else on a small machine, and that noise costs no more.

import { createDecoder } from '#shared/codec/decoder.ts';
import { encodeCommand } from '#shared/codec/encode.ts';
import { family } from '#shared/codec/families.ts';
import { boardWords, chunksOf, hostCommands, lookalikeNoise, randomNoise, toNaive } from './codecInputs.ts';
import type { Figure } from './figure.ts';
import { createNaiveDecoder, naiveEncode } from './naive.ts';
import { REPETITIONS, throughputsMBs, type Work } from './throughput.ts';

const INPUT_BYTES = 200_000;
const SAMPLES = `median of ${REPETITIONS} runs`;

/** Kept, so that no optimiser can find the work useless. */
let packetsSeen = 0;

export function measureCodec(): Figure[] {
  const decoded = `bytes in chunks of 64, ${SAMPLES}`;
  return [
    figure('codec.encodeMBs', encodeWorks(), `mixed commands, limits checked (naive: not), ${SAMPLES}`),
    figure('codec.decodeMBs', decodeWorks(boardWords(INPUT_BYTES)), `good packets, ${decoded}`),
    figure('codec.garbageMBs', decodeWorks(randomNoise(INPUT_BYTES)), `random ${decoded}`),
    figure('codec.lookalikeMBs', decodeWorks(lookalikeNoise(INPUT_BYTES)), `header-like ${decoded}`),
  ];
}

interface Contest {
  readonly ours: Work;
  readonly naive: Work;
}

function figure(key: string, { ours, naive }: Contest, note: string): Figure {
  const [value = 0, against = 0] = throughputsMBs([ours, naive]);
  return { key, value, unit: 'MB/s', against: { what: 'naive', value: against }, note };
}

function encodeWorks(): Contest {
  const board = family('doc');
  const naive = hostCommands.map(toNaive);
  return {
    ours: () => hostCommands.reduce((bytes, command) => bytes + encodeCommand(command, board).length, 0),
    naive: () =>
      naive.reduce((bytes, { command, params }) => bytes + naiveEncode(command, params()).length, 0),
  };
}

function decodeWorks(input: Uint8Array): Contest {
  const chunks = chunksOf(input);
  const through = (push: (chunk: Uint8Array) => void) => () => {
    for (const chunk of chunks) push(chunk);
    return input.length;
  };
  return {
    ours: through(createDecoder(() => (packetsSeen += 1)).push),
    naive: through(createNaiveDecoder(() => (packetsSeen += 1))),
  };
}
