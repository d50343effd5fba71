import { isDeepStrictEqual } from 'node:util';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { changedServos, poseAt } from '#shared/group/group.ts';
import type { Frame } from '#shared/codec/commands.ts';
import { framePoses } from './FrameStrip.tsx';

const target = fc.record({ servo: fc.integer({ min: 1, max: 4 }), position: fc.integer({ min: 1, max: 3 }) });
const frame = fc.record({
  durationMs: fc.constant(100),
  targets: fc.uniqueArray(target, { selector: ({ servo }) => servo }),
});

const expectedOf = (frames: readonly Frame[], first: number, end: number) =>
  frames.slice(first, end).map((_, index) => ({
    pose: poseAt(frames, first + index),
    changed: changedServos(frames, first + index),
  }));

test('each frame from anywhere on has the pose and the changes that it has by itself', () => {
  fc.assert(
    fc.property(fc.array(frame), fc.nat(6), fc.nat(12), (frames, first, end) => {
      expect(framePoses(frames, first, end)).toEqual(expectedOf(frames, first, end));
    }),
  );
});

test('after an edit of one frame, those that it leaves as they look are the very same', () => {
  fc.assert(
    fc.property(
      fc.array(frame, { minLength: 1 }),
      frame,
      fc.nat(6),
      fc.nat(6),
      (frames, other, at, first) => {
        const before = framePoses(frames, first, frames.length);
        const edited = frames.with(at % frames.length, other);
        for (const [index, one] of framePoses(edited, first, edited.length).entries()) {
          const was = before[index];
          const isCut = index + first === at % frames.length;
          if (!isCut && isDeepStrictEqual(one, was)) expect(one).toBe(was);
        }
        expect(framePoses(edited, first, edited.length)).toEqual(expectedOf(edited, first, edited.length));
      },
    ),
  );
});
