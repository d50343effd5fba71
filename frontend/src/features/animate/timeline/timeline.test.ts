import { describe, expect, test } from 'vitest';
import { keySet, NO_KEYS, refsOf, selectedKeys, withKeys } from './timeline.ts';
import fc from 'fast-check';
import { deleteFrames } from '#shared/group/groupEdits.ts';
import { reverse } from '#shared/group/timeEdits.ts';
import { allKeys, timesOf } from '#shared/group/groupTimes.ts';
import { smallGroup } from './timelineUnderTest.ts';

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

const SERVOS = [1, 2, 3];
const all = allKeys(timesOf(smallGroup()), SERVOS);
const edits = {
  none: smallGroup(),
  reversed: reverse(smallGroup(), { fromMs: 500, toMs: 1500 }),
  shorter: deleteFrames(smallGroup(), [2]),
};

test('the keys of a set come servo by servo in the order of time, in whatever order they are named', () => {
  fc.assert(
    fc.property(fc.constantFrom(...Object.values(edits)), fc.shuffledSubarray([...all]), (group, named) => {
      const times = timesOf(group);
      const isNamed = (key: (typeof all)[number]): boolean =>
        named.some(({ servo, frameId }) => servo === key.servo && frameId === key.frameId);
      expect(selectedKeys(times, keySet(named))).toEqual(allKeys(times, SERVOS).filter(isNamed));
    }),
  );
});
