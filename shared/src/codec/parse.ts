// Packets to values. Shape decides (command number and LEN), for reports the family too, never the order of arrival.
// Judges no limits: whether a board can take a command is encode.ts.

import { ALL_GROUPS, COMMAND_NUMBER, type Command, type Frame, type ServoTarget } from './commands.ts';
import type { Family } from './families.ts';
import { packetBytes, type Packet } from './packet.ts';
import { SERVO_TYPES, type Report } from './reports.ts';

/** How many servos its answers are about; no count stands in them. */
const LEARM_SERVOS = 6;

/** The command, or null where the packet is not exactly a known one in shape. */
export function parseCommand({ command, params }: Packet): Command | null {
  switch (command) {
    case COMMAND_NUMBER.move: {
      const frame = readFrame(params, 0);
      return frame && { kind: 'move', ...frame };
    }
    case COMMAND_NUMBER.run:
      return params.length === 3 ? { kind: 'run', slot: byteAt(params, 0), times: wordAt(params, 1) } : null;
    case COMMAND_NUMBER.stop:
      return params.length === 0 ? { kind: 'stop' } : null;
    case COMMAND_NUMBER.erase:
      return params.length <= 1 ? { kind: 'erase' } : null; // the reserved byte is not everywhere
    case COMMAND_NUMBER.readBattery:
      return params.length === 0 ? { kind: 'readBattery' } : null;
    case COMMAND_NUMBER.download:
      return readDownload(params);
    default:
      return familyCommand(command, params);
  }
}

/** The same of a packet's bytes, header and all. Stop packets in a row are one stop. */
export function commandIn(packet: Uint8Array): Command | null {
  const command = parseCommand({ command: packet[3] ?? 0, params: packet.subarray(4) });
  return command ?? (stopsIn(packet) > 0 ? { kind: 'stop' } : null);
}

const STOP_BYTES = packetBytes(COMMAND_NUMBER.stop, []);

/** How many stop packets these bytes are; 0 where they are anything else. */
export function stopsIn(bytes: Uint8Array): number {
  const areStops = bytes.every((byte, index) => byte === STOP_BYTES[index % STOP_BYTES.length]);
  return areStops ? Math.floor(bytes.length / STOP_BYTES.length) : 0;
}

/** Those that only some families have. */
function familyCommand(command: number, params: Uint8Array): Command | null {
  switch (command) {
    case COMMAND_NUMBER.setSpeed:
      return params.length === 3 ? readSpeed(params) : null;
    case COMMAND_NUMBER.release: {
      const servos = readServos(params);
      return servos && { kind: 'release', servos };
    }
    case COMMAND_NUMBER.readPositions: {
      const servos = readServos(params);
      return servos && { kind: 'readPositions', servos };
    }
    case COMMAND_NUMBER.readVersion:
      return params.length === 0 ? { kind: 'readVersion' } : null;
    case COMMAND_NUMBER.readAllPositions:
      return params.length === 0 ? { kind: 'readAllPositions' } : null;
    case COMMAND_NUMBER.readOffsets:
      return params.length === 0 ? { kind: 'readOffsets' } : null;
    default:
      return null;
  }
}

function readDownload(params: Uint8Array): Command | null {
  const frame = readFrame(params, 3);
  if (frame === null) return null;
  const [slot, frameCount, frameIndex] = [byteAt(params, 0), byteAt(params, 1), byteAt(params, 2)];
  return { kind: 'download', slot, frameCount, frameIndex, frame };
}

function readSpeed(params: Uint8Array): Command {
  const slot = byteAt(params, 0);
  return { kind: 'setSpeed', slot: slot === ALL_GROUPS ? null : slot, percent: wordAt(params, 1) };
}

/** Count and servos; null where they disagree. */
function readServos(params: Uint8Array): number[] | null {
  return params.length === 1 + byteAt(params, 0) ? Array.from(params.subarray(1)) : null;
}

/** Count, time and entries from `at` to the end; null where the count and the bytes there disagree (S13). */
function readFrame(params: Uint8Array, at: number): Frame | null {
  if (params.length !== at + 3 + 3 * byteAt(params, at)) return null;
  const targets: ServoTarget[] = [];
  for (let entry = at + 3; entry < params.length; entry += 3) {
    targets.push({ servo: byteAt(params, entry), position: wordAt(params, entry + 1) });
  }
  return { durationMs: wordAt(params, at + 1), targets };
}

/** What the packet says when a board of this family sends it; `unknown` where this family is not known to. */
export function parseReport(packet: Packet, family: Family): Report {
  return familyReport(packet, family) ?? { kind: 'unknown', command: packet.command, params: packet.params };
}

function familyReport({ command, params }: Packet, family: Family): Report | null {
  if (params.length === 0) return emptyReport(command, family);
  if (command === 15 && params.length === 2 && family.answers.includes('readBattery')) {
    return { kind: 'battery', batteryMv: wordAt(params, 0) };
  }
  if (command === 21 && family.answers.includes('readPositions')) return readPositions(params);
  if (command === 1 && family.answers.includes('readVersion')) return readVersion(params);
  if (command === 13 && family.answers.includes('readAllPositions')) return readAllPositions(params);
  if (command === 2 && family.answers.includes('readOffsets')) return readOffsets(params);
  if (params.length !== 3 || !family.runReportsNameSlot) return null;
  if (command === 6) return { kind: 'runStarted', slot: byteAt(params, 0), times: wordAt(params, 1) };
  return command === 8 ? { kind: 'runFinished', slot: byteAt(params, 0) } : null;
}

function readPositions(params: Uint8Array): Report | null {
  if (params.length !== 1 + 3 * byteAt(params, 0)) return null;
  return { kind: 'positions', positions: positionsIn(params.subarray(1)) };
}

function readAllPositions(params: Uint8Array): Report | null {
  return params.length === 3 * LEARM_SERVOS ? { kind: 'allPositions', positions: positionsIn(params) } : null;
}

function positionsIn(entries: Uint8Array): ServoTarget[] {
  return eachEntry(entries, 3, (at) => ({
    servo: byteAt(entries, at),
    position: signed(wordAt(entries, at + 1)),
  }));
}

function readOffsets(params: Uint8Array): Report | null {
  if (params.length !== 2 * LEARM_SERVOS) return null;
  const offsets = eachEntry(params, 2, (at) => ({
    servo: byteAt(params, at),
    offset: signedByte(byteAt(params, at + 1)),
  }));
  return { kind: 'offsets', offsets };
}

function eachEntry<T>(entries: Uint8Array, size: number, read: (at: number) => T): T[] {
  return Array.from({ length: entries.length / size }, (_, index) => read(index * size));
}

function readVersion(params: Uint8Array): Report | null {
  const unit = SERVO_TYPES[byteAt(params, 0)] ?? null;
  return params.length === 2 && unit !== null ? { kind: 'version', unit, version: byteAt(params, 1) } : null;
}

const signed = (word: number): number => (word << 16) >> 16;
const signedByte = (byte: number): number => (byte << 24) >> 24;

function emptyReport(command: number, family: Family): Report | null {
  const { answers, emptySeven } = family;
  if (command === 6 && answers.includes('run')) return { kind: 'runAccepted' };
  if (command === 7 && emptySeven === 'runFinished') return { kind: 'runFinished', slot: null };
  if (command === 7 && emptySeven === 'runStopped') return { kind: 'runStopped' };
  if (command === 8 && answers.includes('erase')) return { kind: 'erased' };
  return command === 25 && answers.includes('download') ? { kind: 'frameStored' } : null;
}

function byteAt(bytes: Uint8Array, at: number): number {
  return bytes[at] ?? 0;
}

function wordAt(bytes: Uint8Array, at: number): number {
  return byteAt(bytes, at) | (byteAt(bytes, at + 1) << 8);
}
