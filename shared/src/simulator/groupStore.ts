// Action groups in flash: a frame's bytes, the chip, and how long writing blocks the board (S32-S41). Knows the layout and the
// chip's times, not what a frame means to the servos.

import type { Frame } from '../codec/commands.ts';
import type { Work } from './agenda.ts';

// One frame as the board keeps it: count, time, then servo and position of each entry.

/** Little-endian, as everything on this board; what lies behind the end reads as 0. */
export function readUint16(bytes: Uint8Array, at: number): number {
  return (bytes[at] ?? 0) | ((bytes[at + 1] ?? 0) << 8);
}

/** Two bytes, low first. */
export function uint16(value: number): number[] {
  return [value & 0xff, value >> 8];
}

export function encodeFrame({ durationMs, targets }: Frame): number[] {
  const entries = targets.flatMap(({ servo, position }) => [servo, ...uint16(position)]);
  return [targets.length, ...uint16(durationMs), ...entries];
}

/** Null where the count is larger than the board plays: an erased frame reads 255 (S35, S38). */
export function decodeFrame(bytes: Uint8Array, servosPlayed: number): Frame | null {
  const count = bytes[0] ?? 0;
  if (count > servosPlayed) return null;
  const targets = Array.from({ length: count }, (_, entry) => ({
    servo: bytes[3 + entry * 3] ?? 0,
    position: readUint16(bytes, 4 + entry * 3),
  }));
  return { durationMs: readUint16(bytes, 1), targets };
}

// The flash chip: bytes that survive power-off, erased in sectors to FF, programmed by clearing bits (NOR). Changes
// are instant here; the group store says how long they block the board.

export interface FlashChip {
  /** A copy of `length` bytes. */
  read(address: number, length: number): Uint8Array;
  /** Bits can only be cleared: what was there and what comes are ANDed (S36). */
  program(address: number, bytes: Uint8Array): void;
  /** Erases the sector that holds `address`. */
  eraseSector(address: number): void;
}

const SECTOR_BYTES = 4096;
const ERASED = 0xff;

export function createFlashChip(): FlashChip {
  /** Only what was ever programmed takes memory: the chip has 8 MiB. */
  const sectors = new Map<number, Uint8Array>();

  function sectorOf(address: number): number {
    return Math.floor(address / SECTOR_BYTES);
  }

  function byteAt(address: number): number {
    return sectors.get(sectorOf(address))?.[address % SECTOR_BYTES] ?? ERASED;
  }

  function read(address: number, length: number): Uint8Array {
    return Uint8Array.from({ length }, (_, index) => byteAt(address + index));
  }

  function programByte(address: number, byte: number): void {
    const sector = sectors.get(sectorOf(address)) ?? new Uint8Array(SECTOR_BYTES).fill(ERASED);
    sectors.set(sectorOf(address), sector);
    sector[address % SECTOR_BYTES] = byteAt(address) & byte;
  }

  function program(address: number, bytes: Uint8Array): void {
    for (const [index, byte] of bytes.entries()) programByte(address + index, byte);
  }

  return { read, program, eraseSector: (address) => void sectors.delete(sectorOf(address)) };
}

/** Which frame of which group a download packet names. */
interface FramePlace {
  readonly slot: number;
  readonly frameIndex: number;
  readonly frameCount: number;
}

export interface GroupStore {
  readonly frameBytes: number;
  readonly frameCount: (slot: number) => number;
  /** What flash holds there, whatever the count says: count, time lo, time hi, then (servo, pos lo, pos hi). */
  readFrame(slot: number, frameIndex: number): Uint8Array;
  /** `payload` is called only when the bytes go to the chip, after the erase (S10, S11). */
  saveFrame(place: FramePlace, payload: () => Uint8Array): Work;
  /** Clears the counts of all groups; the frames stay (S19). */
  clearCounts(): Work;
  /** Puts groups where none are, by slot and in no time: what was stored before the test. */
  preload(groups: ReadonlyMap<number, readonly Frame[]>): void;
}

/** How much room a frame and a group have. */
interface StoreLayout {
  readonly frameBytes: number;
  readonly groupBytes: number;
  readonly groupCount: number;
}

const MARKER = Uint8Array.from('LOBOT', (letter) => letter.charCodeAt(0));
const MARKER_AT = 0;
const COUNTS_AT = 4096;
const GROUPS_AT = 8192;
const GROUP_COUNT = 256;
const FRAMES_PER_GROUP = 256;
const PAGE_PROGRAM_MS = 0.8;
const FRAME_BYTES = 64;

/** 64 bytes hold 20 servos; a board configured for more has a wider frame and twice the sectors. */
export function openLayout(servosPerFrame: number): StoreLayout {
  const frameBytes = servosPerFrame * 3 + 3 <= FRAME_BYTES ? FRAME_BYTES : FRAME_BYTES * 2;
  return { frameBytes, groupBytes: frameBytes * FRAMES_PER_GROUP, groupCount: GROUP_COUNT };
}

export function createGroupStore(chip: FlashChip, sectorMs: number, layout: StoreLayout): GroupStore {
  const { frameBytes, groupBytes, groupCount } = layout;

  function frameAt(slot: number, frameIndex: number): number {
    return GROUPS_AT + slot * groupBytes + frameIndex * frameBytes;
  }

  function* eraseSector(address: number): Work {
    yield sectorMs;
    chip.eraseSector(address);
  }

  function* program(address: number, bytes: Uint8Array): Work {
    yield PAGE_PROGRAM_MS;
    chip.program(address, bytes);
  }

  /** Power lost between the two steps leaves every count at 255 (S40). */
  function* writeCounts(counts: Uint8Array): Work {
    yield* eraseSector(COUNTS_AT);
    yield* program(COUNTS_AT, counts);
  }

  function* saveFrame({ slot, frameIndex, frameCount }: FramePlace, payload: () => Uint8Array): Work {
    if (slot >= groupCount) return;
    const groupAt = frameAt(slot, 0);
    for (let offset = 0; frameIndex === 0 && offset < groupBytes; offset += SECTOR_BYTES) {
      yield* eraseSector(groupAt + offset);
    }
    yield* program(frameAt(slot, frameIndex), payload());
    if (frameIndex + 1 !== frameCount) return;
    const counts = chip.read(COUNTS_AT, GROUP_COUNT);
    counts[slot] = frameCount;
    yield* writeCounts(counts);
  }

  /** A chip without the marker is new: marked, all counts cleared (S32). */
  function prepare(): void {
    if (chip.read(MARKER_AT, MARKER.length).every((byte, index) => byte === MARKER[index])) return;
    chip.eraseSector(MARKER_AT);
    chip.program(MARKER_AT, MARKER);
    chip.eraseSector(COUNTS_AT);
    chip.program(COUNTS_AT, new Uint8Array(GROUP_COUNT));
  }

  function preload(groups: ReadonlyMap<number, readonly Frame[]>): void {
    const counts = chip.read(COUNTS_AT, GROUP_COUNT);
    for (const [slot, frames] of groups) {
      if (counts[slot] !== 0) continue;
      counts[slot] = frames.length;
      for (const [index, frame] of frames.entries())
        chip.program(frameAt(slot, index), Uint8Array.from(encodeFrame(frame)));
    }
    chip.eraseSector(COUNTS_AT);
    chip.program(COUNTS_AT, counts);
  }

  prepare();
  return {
    frameBytes,
    preload,
    frameCount: (slot) => chip.read(COUNTS_AT + slot, 1)[0] ?? 0,
    readFrame: (slot, frameIndex) => chip.read(frameAt(slot, frameIndex), frameBytes),
    saveFrame,
    clearCounts: () => writeCounts(new Uint8Array(GROUP_COUNT)),
  };
}
