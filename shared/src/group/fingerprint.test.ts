import fc from 'fast-check';
import { expect, test } from 'vitest';
import { framesOf, numbersOf } from './fingerprint.ts';

const frame = fc.record({
  durationMs: fc.integer({ min: 0, max: 30_000 }),
  targets: fc.array(fc.record({ servo: fc.nat(255), position: fc.integer({ min: -100, max: 2500 }) })),
});

test('frames are the same after their way as numbers', () => {
  fc.assert(
    fc.property(fc.array(frame), (frames) => {
      expect(framesOf(Int32Array.from(numbersOf(frames)))).toEqual(frames);
    }),
  );
});
