// Where action groups lie in flash, and how long writing them blocks the board (S32-S41). Knows the layout and the chip's
// times, not what a frame means to the servos.

import type { Frame } from '../codec/commands.ts';
import { SECTOR_BYTES, type FlashChip } from './flashChip.ts';
import { encodeFrame } from './storedFrame.ts';
import type { Work } from './work.ts';

/** Which frame of which group a download packet names. */
export interface FramePlace {
  readonly slot: number;
  readonly frameIndex: number;
  readonly frameCount: number;
}

export interface GroupStore {
  readonly frameBytes: number;
  readonly frameCount: (slot: number) => number;
  /** What flash holds there, whatever the count says: count, time lo, time hi, then (servo, pos lo, pos hi). */
  readFrame(slot: number, frameIndex: number): Uint8Array;
  /** `payload` is asked only when the bytes go to the chip, after the erase (S10, S11). */
  saveFrame(place: FramePlace, payload: () => Uint8Array): Work;
  /** Clears the counts of all groups; the frames stay (S19). */
  clearCounts(): Work;
  /** Puts groups where none are, by slot and in no time: what was stored before anybody looked. */
  preload(groups: ReadonlyMap<number, readonly Frame[]>): void;
}

/** How much room a frame and a group have. */
export interface StoreLayout {
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
