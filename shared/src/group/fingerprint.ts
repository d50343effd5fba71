// A short name for frames that are the same to the last number: two groups with one fingerprint move alike. Guards against
// mistakes, not against malice. Knows no board.

import type { Frame } from '../codec/commands.ts';
import { numbersOf } from './frameNumbers.ts';

/** FNV-1a, 32 bits, from two beginnings: 64 bits, as hex. */
export function fingerprintOf(frames: readonly Frame[]): string {
  const words = numbersOf(frames);
  return [0x811c9dc5, 0x01000193].map((seed) => hashOf(words, seed).toString(16).padStart(8, '0')).join('');
}

function hashOf(words: readonly number[], seed: number): number {
  let hash = seed;
  for (const word of words) {
    hash = Math.imul(hash ^ (word & 0xff), 0x01000193);
    hash = Math.imul(hash ^ (word >>> 8), 0x01000193);
  }
  return hash >>> 0;
}
