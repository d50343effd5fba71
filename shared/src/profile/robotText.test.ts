import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { KIT_PARTS, kitFromText, kitToText, mergedKits, sameKit, type Kit } from './robotText.ts';

const BASE: Kit = { robot: 'arm', poses: null, buttons: '[]', pad: null };
const word = fc.constantFrom('one', 'two', 'three');
const anyKit: fc.Arbitrary<Kit> = fc.record({
  robot: word,
  poses: fc.option(word),
  buttons: fc.option(word),
  pad: fc.option(word),
});

describe('a robot with all that belongs to it', () => {
  test('is a text and comes back from it', () => {
    expect(kitFromText(kitToText(BASE))).toEqual(BASE);
    for (const text of ['', '{}', kitToText(BASE).replace('"version":1', '"version":2')])
      expect(kitFromText(text)).toBeNull();
  });

  test('takes both changes where they are about different parts', () => {
    const ours = { ...BASE, poses: 'ours' };
    const theirs = { ...BASE, robot: 'theirs', pad: 'theirs' };
    expect(mergedKits(BASE, ours, theirs)).toEqual({ ...theirs, poses: 'ours' });
    expect(mergedKits(BASE, { ...BASE, robot: 'ours' }, theirs)).toBeNull();
  });

  test('loses no change of either side, whichever is first', () => {
    fc.assert(
      fc.property(anyKit, anyKit, anyKit, (base, ours, theirs) => {
        const merged = mergedKits(base, ours, theirs);
        expect(mergedKits(base, theirs, ours)).toEqual(merged);
        for (const side of merged === null ? [] : [ours, theirs])
          for (const name of KIT_PARTS)
            if (side[name] !== base[name]) expect(merged?.[name]).toBe(side[name]);
        if (sameKit(base, ours)) expect(merged).toEqual(theirs);
      }),
    );
  });
});
