import { expect, test } from 'vitest';
import { createDecoder } from '#shared/codec/decoder.ts';
import { encodeCommand } from '#shared/codec/encode.ts';
import { family } from '#shared/codec/families.ts';
import { toHex } from '#shared/codec/packet.ts';
import { boardWords, chunksOf, hostCommands, toNaive } from './codecInputs.ts';
import { createNaiveDecoder, naiveEncode } from './naive.ts';

test('on a clean line both decoders find the same packets, so they are timed for the same work', () => {
  const ours: string[] = [];
  const naive: string[] = [];
  const decoder = createDecoder((event) => ours.push(toHex(event.bytes)));
  const feedNaive = createNaiveDecoder((packet) => naive.push(toHex(packet)));
  for (const chunk of chunksOf(boardWords(20_000))) {
    decoder.push(chunk);
    feedNaive(chunk);
  }
  expect(ours.length).toBeGreaterThan(3_000);
  expect(ours).toEqual(naive);
});

test('both encoders make the same bytes', () => {
  const ours = hostCommands.map((command) => toHex(encodeCommand(command, family('doc'))));
  const naive = hostCommands.map(toNaive).map(({ command, params }) => toHex(naiveEncode(command, params())));
  expect(ours).toEqual(naive);
});
