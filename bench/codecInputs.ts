// What the codec is timed with: the commands of a working host, the words of a working board, and noise. The same on
// every run. Knows no clock and no figure.

import type { Command, ServoTarget } from '#shared/codec/commands.ts';
import { encodeCommand, encodeReport } from '#shared/codec/encode.ts';
import { family } from '#shared/codec/families.ts';
import type { Report } from '#shared/codec/reports.ts';
import { createRandom } from '#shared/simulator/faults.ts';

/** What a serial adapter hands over at once, at most: one full-speed USB packet. */
const CHUNK_BYTES = 64;
const SEED = 9600;
const MOVE_SIZES = [1, 2, 6, 6, 6, 16, 32];

/** Mostly moves, as sliders and players send them, and each of the other five. */
export const hostCommands: readonly Command[] = [
  ...MOVE_SIZES.map((count): Command => ({ kind: 'move', durationMs: 200, targets: targets(count) })),
  {
    kind: 'download',
    slot: 5,
    frameCount: 21,
    frameIndex: 7,
    frame: { durationMs: 300, targets: targets(6) },
  },
  { kind: 'run', slot: 5, times: 2 },
  { kind: 'readBattery' },
  { kind: 'stop' },
  { kind: 'erase' },
];

/** The same command as the naive encoder takes it: a number and its parameter bytes, made anew at each call. */
export function toNaive(command: Command): { command: number; params: () => readonly number[] } {
  const packet = encodeCommand(command, family('doc'));
  const number = packet[3] ?? 0;
  if (command.kind !== 'move') return { command: number, params: () => [...packet.subarray(4)] };
  return {
    command: number,
    params: () => [
      command.targets.length,
      ...low(command.durationMs),
      ...command.targets.flatMap(({ servo, position }) => [servo, ...low(position)]),
    ],
  };
}

/** At least `byteCount` bytes of good reports: acknowledgements, run ends, battery readings. */
export function boardWords(byteCount: number): Uint8Array {
  const random = createRandom(SEED);
  const words: number[] = [];
  while (words.length < byteCount) words.push(...encodeReport(anyReport(random)));
  return Uint8Array.from(words);
}

/** Every byte is as likely as any other. */
export function randomNoise(byteCount: number): Uint8Array {
  const random = createRandom(SEED);
  return Uint8Array.from({ length: byteCount }, () => Math.floor(random() * 256));
}

/** Noise that looks like the beginnings of packets: half of it header bytes, the rest likely lengths and commands. */
export function lookalikeNoise(byteCount: number): Uint8Array {
  const random = createRandom(SEED);
  return Uint8Array.from({ length: byteCount }, () =>
    random() < 0.5 ? 0x55 : 2 + Math.floor(random() * 24),
  );
}

export function chunksOf(bytes: Uint8Array): readonly Uint8Array[] {
  return Array.from({ length: Math.ceil(bytes.length / CHUNK_BYTES) }, (_, index) =>
    bytes.slice(index * CHUNK_BYTES, (index + 1) * CHUNK_BYTES),
  );
}

function targets(count: number): readonly ServoTarget[] {
  return Array.from({ length: count }, (_, index) => ({ servo: index + 1, position: 600 + 57 * index }));
}

function low(word: number): readonly [number, number] {
  return [word & 0xff, word >> 8];
}

function anyReport(random: () => number): Report {
  const reports: readonly Report[] = [
    { kind: 'frameStored' },
    { kind: 'runAccepted' },
    { kind: 'runFinished', slot: null },
    { kind: 'erased' },
    { kind: 'battery', batteryMv: 6_400 + Math.floor(random() * 2_000) },
    { kind: 'runStarted', slot: Math.floor(random() * 20), times: 1 },
  ];
  return reports[Math.floor(random() * reports.length)] ?? { kind: 'frameStored' };
}
