import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { COLOURS } from '../document/schema.ts';
import { EASINGS } from './curves.ts';
import { emptyGroup, type ActionGroup, groupFromText, groupToText } from './group.ts';
import { insertFrame } from './groupEdits.ts';

const frames = fc.array(
  fc.record({
    durationMs: fc.integer({ min: 0, max: 30_000 }),
    targets: fc.uniqueArray(
      fc.record({ servo: fc.integer({ min: 1, max: 32 }), position: fc.integer({ min: 0, max: 2500 }) }),
      { selector: (target) => target.servo, maxLength: 8 },
    ),
    easing: fc.constantFrom(...EASINGS),
    note: fc.string({ maxLength: 200 }),
    colour: fc.option(fc.constantFrom(...COLOURS)),
  }),
  { maxLength: 10 },
);

const SAMPLE = insertFrame(emptyGroup('Wave', 'us'), 0, {
  durationMs: 500,
  targets: [
    { servo: 1, position: 1500 },
    { servo: 2, position: 900 },
  ],
});

const changed = (change: (group: ActionGroup) => object): string =>
  groupToText(change(SAMPLE) as ActionGroup);

const withFrame = (change: object) => (group: ActionGroup) => ({
  ...group,
  frames: group.frames.map((frame) => ({ ...frame, ...change })),
});

describe('a group as text', () => {
  test('is read back as it was', () => {
    fc.assert(
      fc.property(frames, fc.string({ maxLength: 64 }), (list, name) => {
        const group = list.reduce(
          (sum, frame) => insertFrame(sum, sum.frames.length, frame),
          emptyGroup(name, 'us'),
        );
        expect(groupFromText(groupToText(group))).toEqual({ value: group });
      }),
    );
  });

  test('has a sound or none, and a sound may have beats', () => {
    const sound = { id: '0123456789abcdef', fileName: 'march.ogg', startMs: -250 };
    const withSound = (beats: object | null): ActionGroup =>
      ({ ...SAMPLE, sound: { ...sound, beats } }) as ActionGroup;
    for (const group of [SAMPLE, withSound(null), withSound({ firstMs: 120.5, everyMs: 483.871 })])
      expect(groupFromText(groupToText(group))).toEqual({ value: group });
    expect(groupFromText(groupToText(withSound({ firstMs: 0, everyMs: 0 })))).toEqual({
      problem: { code: 'badValue', at: 'content.sound.beats.everyMs' },
    });
  });

  test('any other text is refused and never throws', () => {
    fc.assert(
      fc.property(fc.oneof(fc.string(), fc.json()), (text) => {
        expect(groupFromText(text)).toHaveProperty('problem');
      }),
    );
  });

  test.each([
    ['another version', groupToText(SAMPLE).replace('"version":1', '"version":2'), 'otherVersion'],
    [
      'a unit that does not exist',
      changed((group) => ({ ...group, unit: 'degrees' })),
      'badValue',
      'content.unit',
    ],
    [
      'a name beyond 64 characters',
      changed((group) => ({ ...group, name: 'a'.repeat(65) })),
      'badValue',
      'content.name',
    ],
    [
      'a time that is no whole number',
      changed(withFrame({ durationMs: 1.5 })),
      'badValue',
      'content.frames.0.durationMs',
    ],
    [
      'a target without a position',
      changed(withFrame({ targets: [{ servo: 1 }] })),
      'badValue',
      'content.frames.0.targets.0.position',
    ],
    ['frames that are no list', changed((group) => ({ ...group, frames: {} })), 'badValue', 'content.frames'],
    [
      'an id used twice',
      changed((group) => ({ ...group, frames: [...group.frames, ...group.frames] })),
      'sameNumber',
    ],
    ['a next id that is taken', changed((group) => ({ ...group, nextId: 1 })), 'sameNumber'],
    [
      'servos out of order',
      changed(withFrame({ targets: [2, 1].map((servo) => ({ servo, position: 1500 })) })),
      'servoOrder',
      '1',
    ],
  ])('%s is refused, with the place', (_, text, code, at = '') => {
    expect(groupFromText(text)).toEqual({ problem: { code, at } });
  });
});
