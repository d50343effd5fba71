// What is said of many samples: the middle one and the slow ones. Pure; knows no figure and no unit.

/** Nearest rank: the smallest sample that at least `percent` of all samples do not exceed. Throws where there is none. */
export function percentile(samples: readonly number[], percent: number): number {
  const sorted = [...samples].sort((a, b) => a - b);
  const rank = Math.max(1, Math.ceil((percent / 100) * sorted.length));
  const found = sorted[rank - 1];
  if (found === undefined) throw new RangeError('no samples');
  return found;
}

/** The lower of the two middle ones where their number is even, so that it is always a figure that was measured. */
export function median(samples: readonly number[]): number {
  return percentile(samples, 50);
}
