import fc from 'fast-check';
import { expect, test } from 'vitest';
import { changedServos, poseAt } from '#shared/actions/group/group.ts';
import { framePoses } from './framePoses.ts';

const target = fc.record({ servo: fc.integer({ min: 1, max: 4 }), position: fc.integer({ min: 1, max: 3 }) });
const frame = fc.record({
  durationMs: fc.constant(100),
  targets: fc.uniqueArray(target, { selector: ({ servo }) => servo }),
});

test('each frame from anywhere on has the pose and the changes that it has by itself', () => {
  fc.assert(
    fc.property(fc.array(frame), fc.nat(6), fc.nat(12), (frames, first, end) => {
      const expected = frames.slice(first, end).map((_, index) => ({
        pose: poseAt(frames, first + index),
        changed: changedServos(frames, first + index),
      }));
      expect(framePoses(frames, first, end)).toEqual(expected);
    }),
  );
});
