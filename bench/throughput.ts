// How many bytes a second pieces of work get through, taken in turns so that a slow moment of the machine strikes all of
// them alike. Knows work and bytes, not what is done with them.

import { amount } from './amounts.ts';
import { median } from './statistics.ts';

/** Goes once through its whole input and returns how many bytes that was. */
export type Work = () => number;

export const REPETITIONS = 9;
/** Long enough that a timer's step and one garbage collection do not matter. */
const REPETITION_MS = amount(80, 20);

/** Megabytes (10⁶) a second of each work: the median of the repetitions; the first round only warms up. */
export function throughputsMBs(works: readonly Work[]): readonly number[] {
  const samples = works.map((): number[] => []);
  for (let round = 0; round <= REPETITIONS; round += 1) {
    for (const [index, work] of works.entries()) {
      const speed = speedMBs(work);
      if (round > 0) samples[index]?.push(speed);
    }
  }
  return samples.map(median);
}

function speedMBs(work: Work): number {
  const startMs = performance.now();
  let bytes = 0;
  let elapsedMs = 0;
  while (elapsedMs < REPETITION_MS) {
    bytes += work();
    elapsedMs = performance.now() - startMs;
  }
  return bytes / 1_000 / elapsedMs;
}
