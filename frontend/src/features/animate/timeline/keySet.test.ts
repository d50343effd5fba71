import { describe, expect, test } from 'vitest';
import { keySet, NO_KEYS, refsOf, withKeys } from './timeline.ts';

const [one, two, three] = [
  { frameId: 1, servo: 6 },
  { frameId: 2, servo: 6 },
  { frameId: 2, servo: 16 },
];

describe('a set of keys', () => {
  test('gives back the keys it was made of', () => {
    expect(refsOf(keySet([one, three]))).toEqual([one, three]);
  });

  test('is replaced, added to, or loses what was already in it', () => {
    expect(refsOf(withKeys(keySet([one]), [two], 'replaces'))).toEqual([two]);
    expect(refsOf(withKeys(keySet([one]), [two], 'adds'))).toEqual([one, two]);
    expect(refsOf(withKeys(keySet([one, two]), [two], 'adds'))).toEqual([one, two]);
    expect(refsOf(withKeys(keySet([one, two]), [two], 'toggles'))).toEqual([one]);
    expect(refsOf(withKeys(keySet([one, two]), [two, three], 'toggles'))).toEqual([one, two, three]);
    expect(withKeys(keySet([one]), [], 'toggles')).toEqual(keySet([one]));
    expect(withKeys(keySet([one]), [], 'replaces')).toEqual(NO_KEYS);
  });
});
