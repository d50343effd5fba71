// Frames as numbers one after the other, and back: what is the same is the same to the last number; and a short name for frames,
// so that two groups with one fingerprint move alike. Guards against mistakes, not against malice. Knows no board.

import type { Frame } from '../codec/commands.ts';
import { onBoard, type Robot } from '../profile/robot.ts';

// Frames as numbers one after the other, and back: what is the same is the same to the last number, and numbers go
// from one thread to another without a copy of each frame.

/** Of each frame its time in ms, how many targets it has, then servo and position of each. */
export function numbersOf(frames: readonly Frame[]): readonly number[] {
  return frames.flatMap(({ durationMs, targets }) => [
    durationMs,
    targets.length,
    ...targets.flatMap(({ servo, position }) => [servo, position]),
  ]);
}

/** `numbers` as `numbersOf` made them. */
export function framesOf(numbers: ArrayLike<number>): readonly Frame[] {
  const frames: Frame[] = [];
  let at = 0;
  const next = (): number => numbers[at++] ?? 0;
  while (at < numbers.length) {
    const durationMs = next();
    const targets = Array.from({ length: next() }, () => ({ servo: next(), position: next() }));
    frames.push({ durationMs, targets });
  }
  return frames;
}

/** FNV-1a, 32 bits, from two beginnings: 64 bits, as hex. */
export function fingerprintOf(frames: readonly Frame[]): string {
  return fingerprintOfNumbers(numbersOf(frames));
}

/** Another trim makes another motion of the same frames. */
export function boardFingerprint(robot: Robot, frames: readonly Frame[]): string {
  return fingerprintOf(
    frames.map(({ durationMs, targets }) => ({ durationMs, targets: onBoard(robot, targets) })),
  );
}

export function fingerprintOfNumbers(words: Iterable<number>): string {
  return [0x811c9dc5, 0x01000193].map((seed) => hashOf(words, seed).toString(16).padStart(8, '0')).join('');
}

function hashOf(words: Iterable<number>, seed: number): number {
  let hash = seed;
  for (const word of words) {
    hash = Math.imul(hash ^ (word & 0xff), 0x01000193);
    hash = Math.imul(hash ^ (word >>> 8), 0x01000193);
  }
  return hash >>> 0;
}
