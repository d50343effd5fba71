// Streams as the families send them and as a host does, and what can happen to one byte of them. Bytes are the letters of a
// text here: quick to cut, to join and to compare. Knows packets and chance; no decoder.

import { COMMAND_NUMBER, type Command, type CommandKind, type ServoTarget } from '../../codec/commands.ts';
import { encodeCommand, encodeReport } from '../../codec/encode.ts';
import { FAMILIES, type Family } from '../../codec/families.ts';
import type { Report, ServoOffset } from '../../codec/reports.ts';
import { COMMAND_SHAPES, REPORT_SHAPES, type ShapeRule } from '../../codec/shapes.ts';

/** A whole number from 0, below the limit. */
export type Random = (below: number) => number;

export function belowFrom(random: () => number): Random {
  return (below) => Math.floor(random() * below);
}

export interface Source {
  readonly name: string;
  readonly shape: ShapeRule;
  /** What it says, in no order. */
  readonly packets: readonly string[];
}

/** Different packets of one source. Encoding each stream anew would take most of a test's time. */
const VARIETY = 4_000;

const SIX = [1, 2, 3, 4, 5, 6];

/** What happens to the byte at that place. */
type Damage = (stream: string, at: number, random: Random) => string;

export const DAMAGES: Readonly<Record<'drop' | 'double' | 'insert' | 'flip', Damage>> = {
  drop: (stream, at) => stream.slice(0, at) + stream.slice(at + 1),
  double: (stream, at) => stream.slice(0, at + 1) + stream.slice(at),
  insert: (stream, at, random) => stream.slice(0, at) + letter(random(256)) + stream.slice(at),
  flip: (stream, at, random) =>
    stream.slice(0, at) + letter(stream.charCodeAt(at) ^ (1 + random(255))) + stream.slice(at + 1),
};

const letter = (byte: number): string => String.fromCharCode(byte);

export function textOf(bytes: Uint8Array): string {
  return String.fromCharCode(...bytes);
}

export function bytesOf(text: string): Uint8Array {
  const bytes = new Uint8Array(text.length);
  for (let at = 0; at < text.length; at += 1) bytes[at] = text.charCodeAt(at);
  return bytes;
}

/** What a family sends, empty packets and packets with parameters as often as each other where it has both. */
function reportOf(
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
    return oneOf(kinds, random);
  }
  const empty: [Report, ...Report[]] = [{ kind: 'erased' }, { kind: 'frameStored' }];
  if (answers.includes('run')) empty.push({ kind: 'runAccepted' });
  if (emptySeven === 'runFinished') empty.push({ kind: 'runFinished', slot: null });
  if (answers.includes('readBattery') && random(2) === 0) return battery;
  if (answers.includes('readVersion')) empty.push({ kind: 'version', unit: 'us', version: random(4) });
  if (answers.includes('readAllPositions'))
    empty.push({ kind: 'allPositions', positions: sixPositions(random) });
  if (answers.includes('readOffsets')) empty.push({ kind: 'offsets', offsets: sixOffsets(random) });
  return oneOf(empty, random);
}

function oneOf<Item>(items: readonly Item[], random: Random): Item {
  const item = items[random(items.length)];
  if (item === undefined) throw new RangeError('nothing to choose from');
  return item;
}

function sixPositions(random: Random): readonly ServoTarget[] {
  return SIX.map((servo) => ({ servo, position: 500 + random(2_001) }));
}

function sixOffsets(random: Random): readonly ServoOffset[] {
  return SIX.map((servo) => ({ servo, offset: random(251) - 125 }));
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
  const servos = targets.map((target) => target.servo);
  const frame = { durationMs: random(3_000), targets };
  return oneOf<Command>(
    [
      { kind: 'move', ...frame },
      { kind: 'download', slot: random(256), frameCount: 20, frameIndex: random(20), frame },
      { kind: 'run', slot: random(256), times: random(10) },
      { kind: 'stop' },
      { kind: 'erase' },
      { kind: 'readBattery' },
      { kind: 'setSpeed', slot: random(230), percent: 1 + random(300) },
      { kind: 'release', servos },
      { kind: 'readPositions', servos },
      { kind: 'readVersion' },
      { kind: 'readAllPositions' },
      { kind: 'readOffsets' },
    ],
    random,
  );
}

function spoken(encoded: () => Uint8Array): readonly string[] {
  return Array.from({ length: VARIETY }, () => textOf(encoded()));
}

/** Host to board. */
export function commandSource(random: Random): Source {
  const packets = spoken(() => encodeCommand(commandOf(ANY, random), ANY));
  return { name: 'commands', shape: COMMAND_SHAPES, packets };
}

/** Board to host: one source for all families that say the same. */
export function reportSources(random: Random): readonly Source[] {
  const voices = new Map<string, Family[]>();
  for (const row of Object.values(FAMILIES)) {
    const { answers, emptySeven, runReportsNameSlot, slot, usualServoCount } = row;
    const servos = answers.includes('readPositions') && usualServoCount;
    const voice = JSON.stringify([answers, emptySeven, runReportsNameSlot, slot, servos]);
    voices.set(voice, [...(voices.get(voice) ?? []), row]);
  }
  return [...voices.values()].map((rows) => ({
    name: `reports of ${rows.map(({ id }) => id).join(', ')}`,
    shape: REPORT_SHAPES,
    packets: spoken(() => encodeReport(reportOf(oneOf(rows, random), random))),
  }));
}

export function packetsOf({ packets }: Source, count: number, random: Random): readonly string[] {
  return Array.from({ length: count }, () => oneOf(packets, random));
}
