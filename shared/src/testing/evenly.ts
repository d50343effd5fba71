// Numbers that are as likely anywhere between two others, for properties: fast-check's own doubles are as likely at each size, so
// that between 0 and 1 nearly all of them are next to 0.

import * as fc from 'fast-check';

// Numbers that are as likely anywhere between two others, for properties: fast-check's own doubles are as likely at
// each size, so that between 0 and 1 nearly all of them are next to 0.

const STEPS = 10_000;

export function evenly(min: number, max: number): fc.Arbitrary<number> {
  return fc.integer({ min: 0, max: STEPS }).map((step) => min + ((max - min) * step) / STEPS);
}
