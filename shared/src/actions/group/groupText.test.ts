import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { insertFrame } from './groupEdits.ts';
import { emptyGroup } from './group.ts';
import { groupFromText, groupToText } from './groupText.ts';

const frames = fc.array(
  fc.record({
    durationMs: fc.integer({ min: 0, max: 30_000 }),
    targets: fc.uniqueArray(
      fc.record({ servo: fc.integer({ min: 1, max: 32 }), position: fc.integer({ min: 0, max: 2500 }) }),
      { selector: (target) => target.servo, maxLength: 8 },
    ),
  }),
  { maxLength: 10 },
);

describe('a group as text', () => {
  test('is read back as it was', () => {
    fc.assert(
      fc.property(frames, fc.string({ maxLength: 64 }), (list, name) => {
        const group = list.reduce(
          (sum, frame) => insertFrame(sum, sum.frames.length, frame),
          emptyGroup(name, 'us'),
        );
        expect(groupFromText(groupToText(group))).toEqual(group);
      }),
    );
  });

  test('any other text is refused and never throws', () => {
    fc.assert(
      fc.property(fc.oneof(fc.string(), fc.json()), (text) => {
        expect(groupFromText(text)).toBeNull();
      }),
    );
  });

  test.each([
    ['another version', { version: 2, name: 'a', unit: 'us', frames: [] }],
    ['a unit nobody has', { version: 1, name: 'a', unit: 'degrees', frames: [] }],
    ['a name beyond 64 characters', { version: 1, name: 'a'.repeat(65), unit: 'us', frames: [] }],
    [
      'a time that is no whole number',
      { version: 1, name: 'a', unit: 'us', frames: [{ durationMs: 1.5, targets: [] }] },
    ],
    [
      'a target without a position',
      { version: 1, name: 'a', unit: 'us', frames: [{ durationMs: 1, targets: [{ servo: 1 }] }] },
    ],
    ['frames that are no list', { version: 1, name: 'a', unit: 'us', frames: {} }],
  ])('%s is refused', (_, value) => {
    expect(groupFromText(JSON.stringify(value))).toBeNull();
  });
});
