import { expect, test } from 'vitest';
import fc from 'fast-check';
import { deleteFrames } from '#shared/group/groupEdits.ts';
import { reverse } from '#shared/group/timeEdits.ts';
import { keySet, selectedKeys } from './timeline.ts';
import { allKeys, timesOf } from '#shared/group/groupTimes.ts';
import { smallGroup } from './timelineUnderTest.ts';

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
