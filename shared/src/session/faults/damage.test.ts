// How much one damaged byte costs: good packets lost, and damaged ones believed. Measured over seeded streams of what
// each family sends, with the damage anywhere in the stream. The figures stand in shared/README.md.

import { describe, expect, test } from 'vitest';
import { COMMAND_NUMBER, type Command, type CommandKind } from './commands.ts';
import { createDecoder } from './decoder.ts';
import { encodeCommand, encodeReport } from './encode.ts';
import { FAMILIES, type Family } from './families.ts';
import { toHex } from './hex.ts';
import type { Report } from './reports.ts';
import { COMMAND_SHAPES, REPORT_SHAPES, type ShapeRule } from './shapes.ts';

/** Per kind of damage and source. */
const CASES = 2_500;
const PACKETS_PER_STREAM = 9;
const DAMAGED_AND_NEIGHBOUR = 2;

type Random = (below: number) => number;
type Damage = (bytes: readonly number[], at: number, random: Random) => number[];

const DAMAGES: Readonly<Record<string, Damage>> = {
  drop: (bytes, at) => bytes.toSpliced(at, 1),
  double: (bytes, at) => bytes.toSpliced(at, 0, bytes[at]!),
  insert: (bytes, at, random) => bytes.toSpliced(at, 0, random(256)),
  flip: (bytes, at, random) => bytes.with(at, bytes[at]! ^ (1 + random(255))),
};

/** What a family sends, empty packets and packets with parameters as often as each other where it has both. */
function reportsOf(
  { answers, emptySeven, runReportsNameSlot, slot, usualServoCount }: Family,
  random: Random,
): Report {
  const battery: Report = { kind: 'battery', batteryMv: 5_000 + random(7_600) };
  const named = { slot: random(slot.max + 1), times: random(4) === 0 ? random(65_536) : random(4) };
  if (runReportsNameSlot) {
    const kinds: Report[] = [
      battery,
      { kind: 'runStarted', ...named },
      { kind: 'runFinished', slot: named.slot },
      { kind: 'runStopped' },
    ];
    if (answers.includes('readPositions')) kinds.push(positionsOf(usualServoCount, random));
    return kinds[random(kinds.length)]!;
  }
  const empty: Report[] = [{ kind: 'erased' }, { kind: 'frameStored' }];
  if (answers.includes('run')) empty.push({ kind: 'runAccepted' });
  if (emptySeven === 'runFinished') empty.push({ kind: 'runFinished', slot: null });
  if (answers.includes('readBattery') && random(2) === 0) return battery;
  if (answers.includes('readVersion')) empty.push({ kind: 'version', unit: 'us', version: random(4) });
  return empty[random(empty.length)]!;
}

function positionsOf(servoCount: number, random: Random): Report {
  const positions = Array.from({ length: servoCount }, (_, i) => ({ servo: i + 1, position: random(1001) }));
  return { kind: 'positions', positions };
}

/** Takes every command there is. */
const ANY: Family = {
  ...FAMILIES.doc,
  commands: Object.keys(COMMAND_NUMBER) as CommandKind[],
  speedPercent: FAMILIES['bus-ctrl'].speedPercent,
};

function commandOf({ position, servo }: Family, random: Random): Command {
  const targets = Array.from({ length: 1 + random(6) }, (_, i) => ({
    servo: servo.min + i,
    position: position.min + random(position.max - position.min + 1),
  }));
  const frame = { durationMs: random(3_000), targets };
  const kinds: Command[] = [
    { kind: 'move', ...frame },
    { kind: 'download', slot: random(256), frameCount: 20, frameIndex: random(20), frame },
    { kind: 'run', slot: random(256), times: random(10) },
    { kind: 'stop' },
    { kind: 'erase' },
    { kind: 'readBattery' },
    { kind: 'setSpeed', slot: random(230), percent: 1 + random(300) },
    { kind: 'release', servos: targets.map(({ servo: one }) => one) },
    { kind: 'readPositions', servos: targets.map(({ servo: one }) => one) },
    { kind: 'readVersion' },
  ];
  return kinds[random(kinds.length)]!;
}

interface Source {
  readonly name: string;
  readonly shape: ShapeRule;
  readonly packet: (random: Random) => Uint8Array;
}

const SOURCES: readonly Source[] = [
  ...Object.values(FAMILIES).map((row) => ({
    name: `reports of ${row.id}`,
    shape: REPORT_SHAPES,
    packet: (random: Random) => encodeReport(reportsOf(row, random)),
  })),
  {
    name: 'commands',
    shape: COMMAND_SHAPES,
    packet: (random) => encodeCommand(commandOf(ANY, random), ANY),
  },
];

/** xorshift32: seeded, so that a failure comes back. */
function seededRandom(seed: number): Random {
  let state = seed;
  return (below) => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) % below;
  };
}

function decodeAll(bytes: readonly number[], shape: ShapeRule): string[] {
  const packets: string[] = [];
  const decoder = createDecoder((event) => {
    if (event.kind === 'packet') packets.push(toHex(event.bytes));
  }, shape);
  decoder.push(Uint8Array.from(bytes));
  decoder.idle();
  return packets;
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

/** One stream with one damaged byte: how many sent packets are missing, how many that nobody sent were believed. */
function damageOnce(source: Source, damage: Damage, random: Random): { lost: number; believed: number } {
  const packets = Array.from({ length: PACKETS_PER_STREAM }, () => source.packet(random));
  const bytes = packets.flatMap((packet) => Array.from(packet));
  const got = decodeAll(damage(bytes, random(bytes.length), random), source.shape);
  const good = arrived(packets.map(toHex), got);
  return { lost: packets.length - good, believed: got.length - good };
}

function measure(source: Source, damage: Damage): { mostLost: number; believedShare: number } {
  const random = seededRandom(20_250_101);
  let [mostLost, believed] = [0, 0];
  for (let i = 0; i < CASES; i++) {
    const one = damageOnce(source, damage, random);
    mostLost = Math.max(mostLost, one.lost);
    believed += one.believed;
  }
  return { mostLost, believedShare: believed / CASES };
}

describe.each(SOURCES)('one damaged byte in $name', (source) => {
  test.each(['drop', 'double', 'insert'])(
    '%s: one good neighbour lost at most, one wrong packet in a hundred believed',
    (kind) => {
      const { mostLost, believedShare } = measure(source, DAMAGES[kind]!);
      expect(mostLost).toBeLessThanOrEqual(DAMAGED_AND_NEIGHBOUR);
      expect(believedShare).toBeLessThanOrEqual(0.01);
    },
  );

  test('flip: one good neighbour lost at most; a changed value shows nowhere', () => {
    expect(measure(source, DAMAGES.flip!).mostLost).toBeLessThanOrEqual(DAMAGED_AND_NEIGHBOUR);
  });
});
