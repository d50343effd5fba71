// The made-up files of shared/protocol/vectors/files with what they mean, for tests.

import meanings from '../../protocol/vectors/files/meanings.json' with { type: 'json' };
import type { Reading } from '../files/reading.ts';

export const MEANINGS = meanings;

/** As the twin of a fixture says it. */
export function meaningOf(reading: Reading) {
  if ('problem' in reading) return reading;
  const { groups, asksUnit, remarks } = reading;
  return groups.map(({ name, slot, unit, frames }) => ({
    ...{ name, slot, unit, asksUnit, remarks: remarks.map(({ code }) => code) },
    frames: frames.map(({ durationMs, targets }) => ({ durationMs, targets })),
  }));
}
