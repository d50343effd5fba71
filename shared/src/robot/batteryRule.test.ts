import { expect, test } from 'vitest';
import vectors from '../../protocol/vectors/batteryRule.json' with { type: 'json' };
import { verdict } from './batteryRule.ts';

test.each(vectors)('$what', ({ limit, batteryMv, ageMs, verdict: expected }) => {
  expect(verdict(limit, batteryMv, ageMs)).toBe(expected);
});
