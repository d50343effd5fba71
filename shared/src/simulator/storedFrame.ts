// One frame as the board keeps it: count, time, then servo and position of each entry. Knows bytes, no flash and no time.

import type { Frame } from '../codec/commands.ts';

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
