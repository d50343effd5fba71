// When the board has a reading of its battery. Knows slots of the loop, no packet.

import type { Slots } from './slots.ts';

/** A sample of the battery every so many slots of 10 ms; none before the first (S59). */
const SLOTS_PER_SAMPLE = 50;

/** 0 before the first sample. */
export function createBatterySampler(slots: Slots, batteryMv: number): () => number {
  return () => (slots.taken() < SLOTS_PER_SAMPLE ? 0 : batteryMv);
}
