import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { withBegun } from './slotPlaces.ts';
import { compareFrames } from './frames.ts';
import { fingerprintOf } from './fingerprint.ts';
import {
  EMPTY_SLOT_BOOK,
  contentOf,
  notRestored,
  recordOf,
  slotBookFromText,
  slotBookToText,
  withErased,
  withErasing,
  withStored,
  withUnknown,
  withVersions,
  type SlotRecord,
} from './slotBook.ts';

const at = (durationMs: number, ...positions: readonly number[]) => ({
  durationMs,
  targets: positions.map((position, index) => ({ servo: index + 1, position })),
});
const WAVE = [at(400, 1000, 1500), at(600, 2000, 1500)];

const record = (slot: number, name = 'Wave', frames = WAVE): SlotRecord => ({
  ...{ slot, name, frames, documentId: `id of ${name}`, storedAtMs: 1_700_000_000_000 },
  fingerprint: fingerprintOf(frames),
});

const someFrames = fc.array(
  fc.record({
    durationMs: fc.integer({ min: 0, max: 30_000 }),
    targets: fc.array(
      fc.record({ servo: fc.integer({ min: 1, max: 32 }), position: fc.integer({ min: 0, max: 2500 }) }),
      { maxLength: 6 },
    ),
  }),
  { minLength: 1, maxLength: 12 },
);

const NOW = { broken: [], arriving: null, versions: {} };

describe('a fingerprint', () => {
  test('is the same for the same frames, and another one after any change of a number', () => {
    fc.assert(
      fc.property(someFrames, fc.nat(), fc.integer({ min: 1, max: 50 }), (frames, where, change) => {
        expect(fingerprintOf(structuredClone(frames))).toBe(fingerprintOf(frames));
        const index = where % frames.length;
        const changed = frames.with(index, {
          ...frames[index]!,
          durationMs: frames[index]!.durationMs + change,
        });
        expect(fingerprintOf(changed)).not.toBe(fingerprintOf(frames));
      }),
    );
  });

  test('knows where a number stands', () => {
    expect(fingerprintOf([at(400, 1000, 1500)])).not.toBe(fingerprintOf([at(400, 1500, 1000)]));
    expect(fingerprintOf(WAVE)).not.toBe(fingerprintOf(WAVE.toReversed()));
  });
});

describe('the book of slots', () => {
  const group = { documentId: 'id of Wave', fingerprint: fingerprintOf(WAVE) };
  const edited = { ...group, fingerprint: 'another' };

  test('says of a slot what anybody can know', () => {
    const book = withStored(withStored(EMPTY_SLOT_BOOK, record(5)), record(7, 'Bow', [at(100, 1200)]));
    expect(contentOf(book, NOW, 5, group)).toBe('same');
    expect(contentOf(book, NOW, 5, edited)).toBe('older');
    expect(contentOf(book, NOW, 7, group)).toBe('other');
    expect(contentOf(book, NOW, 8, group)).toBe('unknown');
    expect(contentOf(book, { ...NOW, broken: [5] }, 5, group)).toBe('broken');
    expect(contentOf(book, { ...NOW, broken: [5], arriving: 5 }, 5, group)).toBe('arriving');
    expect(contentOf(book, NOW, 5, null)).toBe('other');
  });

  test('knows a group from one that only has the name', () => {
    const book = withStored(EMPTY_SLOT_BOOK, record(5));
    expect(contentOf(book, NOW, 5, { ...edited, documentId: 'id of another' })).toBe('other');
  });

  test('of an earlier version is read, and takes no group of the same name for an older version', () => {
    const book = { stored: [{ ...record(5), frames: [[400, 1, 1000]] }], erased: [], isEmptied: false };
    const text = JSON.stringify(
      { format: 'servodeck-slots', version: 1, content: book },
      (key, value: unknown) => (key === 'documentId' ? undefined : value),
    );
    const read = slotBookFromText(text);
    if (!('value' in read)) throw new Error(read.problem.code);
    expect(contentOf(read.value, NOW, 5, group)).toBe('same');
    expect(contentOf(read.value, NOW, 5, edited)).toBe('other');
    expect(JSON.parse(slotBookToText(read.value))).toEqual(JSON.parse(text));
  });

  test('of an earlier version may have one group on its way', () => {
    const text = slotBookToText(withBegun(EMPTY_SLOT_BOOK, [record(5)]));
    const { content, ...file } = JSON.parse(text) as { content: { begun: unknown[] } };
    const earlier = { ...file, content: { ...content, begun: content.begun[0] } };
    expect(slotBookFromText(JSON.stringify(earlier))).toEqual(slotBookFromText(text));
  });

  test('does not know what another client has stored', () => {
    const book = withErased(withErasing(withStored(EMPTY_SLOT_BOOK, record(5))));
    expect(contentOf(withUnknown(book, 9), NOW, 9, group)).toBe('unknown');
    expect(contentOf(withUnknown(withStored(book, record(5)), 5), NOW, 5, group)).toBe('unknown');
  });

  test('a copy of the very same motion is up to date under any name', () => {
    const book = withStored(EMPTY_SLOT_BOOK, record(5, 'Greeting'));
    expect(contentOf(book, NOW, 5, group)).toBe('same');
  });

  test('keeps what an erase took until it is downloaded again', () => {
    const stored = withStored(withStored(EMPTY_SLOT_BOOK, record(5)), record(7, 'Bow'));
    const erasing = withErasing(stored);
    expect(contentOf(erasing, NOW, 5, group)).toBe('unknown');
    const erased = withErased(erasing);
    expect(contentOf(erased, NOW, 5, group)).toBe('empty');
    expect(erased.erased.map(({ slot }) => slot)).toEqual([5, 7]);
    const restored = withStored(erased, record(5));
    expect(restored.erased.map(({ slot }) => slot)).toEqual([7]);
    expect(contentOf(restored, NOW, 5, group)).toBe('same');
    expect(withErasing(withStored(restored, record(9))).erased.map(({ slot }) => slot)).toEqual([5, 7, 9]);
  });

  test('comes back from its text', () => {
    fc.assert(
      fc.property(someFrames, (frames) => {
        const book = withErased(withErasing(withStored(EMPTY_SLOT_BOOK, record(3, 'Wave', frames))));
        const both = withStored(book, record(9, 'Bow', frames));
        const begun = withBegun(both, [record(10, 'Nod', frames), record(2, 'Nod', frames)]);
        for (const each of [both, begun])
          expect(slotBookFromText(slotBookToText(each))).toEqual({ value: each });
      }),
    );
  });

  test('is not taken from any other text', () => {
    for (const text of ['', '{}', '{"format":"servodeck-slots","version":1,"content":{"stored":[7]}}'])
      expect(slotBookFromText(text)).toHaveProperty('problem');
  });
});

test('an erase takes what others stored; what a download broke is gone already, whichever client began it', () => {
  const stored = (name: string) => ({ name, version: 'a', documentId: null });
  const book = withStored(EMPTY_SLOT_BOOK, record(5));
  const versions = { 5: stored('Wave'), 6: stored('Nod'), 7: stored('Bow') };
  expect(notRestored(book, { versions, broken: [7] })).toEqual([{ slot: 6, name: 'Nod' }]);
});

describe('comparing two groups', () => {
  test('finds the first frame that differs, and the servos in it', () => {
    const other = [WAVE[0]!, at(600, 2000, 1400), at(100, 900)];
    expect(compareFrames(WAVE, other)).toEqual({
      isSame: false,
      frameCounts: [2, 3],
      durationsMs: [1000, 1100],
      firstDifferent: 1,
      servos: [{ servo: 2, positions: [1500, 1400] }],
    });
  });

  test('says where only the times differ, or only the length', () => {
    expect(compareFrames(WAVE, [WAVE[0]!, at(700, 2000, 1500)])).toMatchObject({
      isSame: false,
      firstDifferent: 1,
      servos: [],
    });
    expect(compareFrames(WAVE, WAVE.slice(0, 1))).toMatchObject({ isSame: false, firstDifferent: null });
    expect(compareFrames(WAVE, structuredClone(WAVE))).toMatchObject({ isSame: true, firstDifferent: null });
  });
});

describe('the word of a gateway that sees all downloads', () => {
  const versionOf = (version: string, documentId: string | null = null) => ({ version, documentId });
  const book = [record(3), record(5, 'Bow', [at(400, 1200)])].reduce(withStored, EMPTY_SLOT_BOOK);
  const versions = Object.fromEntries(
    book.stored.map(({ slot, fingerprint }) => [slot, versionOf(fingerprint)]),
  );

  test('says of what others have stored whether it is the open group, an earlier one of it, or another', () => {
    const group = { documentId: 'id of Wave', fingerprint: fingerprintOf(WAVE) };
    const contentOfVersion = (stored: ReturnType<typeof versionOf>) =>
      contentOf(book, { ...NOW, versions: { 8: stored } }, 8, group);
    expect(contentOfVersion(versionOf(group.fingerprint))).toBe('same');
    expect(contentOfVersion(versionOf('another', 'id of Wave'))).toBe('older');
    expect(contentOfVersion(versionOf('another', 'id of Bow'))).toBe('other');
    expect(contentOfVersion(versionOf('another'))).toBe('other');
    expect(contentOf(book, { ...NOW, versions: { 8: versionOf('another') } }, 9, group)).toBe('unknown');
  });

  test('takes from the book what is not there any more, and nothing else', () => {
    expect(withVersions(book, { ...versions, 9: versionOf('another') })).toBe(book);
    expect(withVersions(book, { ...versions, 5: versionOf('another') }).stored).toEqual([recordOf(book, 3)]);
    expect(withVersions(book, {}).stored).toEqual([]);
  });

  test('what another client erased can be brought back, until that is done or something else is put there', () => {
    const erased = withVersions(book, { 3: versions[3]! });
    expect([erased.stored, erased.erased]).toEqual([[recordOf(book, 3)], [recordOf(book, 5)]]);
    expect(withVersions(erased, { 3: versions[3]! })).toBe(erased);
    expect(withVersions(erased, versions)).toEqual(book);
    expect(withVersions(erased, { 3: versions[3]!, 5: versionOf('another') }).erased).toEqual([]);
  });

  test('what another client stored is kept as theirs', () => {
    const theirs = withStored(book, { ...record(7), by: 'Bert' });
    expect(slotBookFromText(slotBookToText(theirs))).toEqual({ value: theirs });
  });

  test('a board of which every slot is known to be empty is one no more where something was stored', () => {
    const emptied = withStored(withErased(EMPTY_SLOT_BOOK), record(3));
    expect(withVersions(emptied, { 3: versionOf(record(3).fingerprint) })).toBe(emptied);
    expect(
      withVersions(emptied, { 3: versionOf(record(3).fingerprint), 4: versionOf('another') }).isEmptied,
    ).toBe(false);
  });
});
