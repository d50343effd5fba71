import { expect, test } from 'vitest';
import { concerns, withBegun, withDownload, type LatestDownload } from './slotPlaces.ts';
import { EMPTY_SLOT_BOOK, withStored, type SlotBook, type SlotRecord } from './slotBook.ts';

const record = (slot: number, name: string): SlotRecord => ({
  ...{ slot, name, documentId: null, storedAtMs: 0, fingerprint: name },
  frames: [{ durationMs: 400, targets: [] }],
});
const BEFORE = [5, 9, 12].map((slot) => record(slot, 'Old')).reduce(withStored, EMPTY_SLOT_BOOK);
const BOOK = withBegun(
  BEFORE,
  [9, 5, 12].map((slot) => record(slot, 'New')),
);
const latest = (groupsStored: number, isOver: boolean): LatestDownload => ({
  ...{ slots: [9, 5, 12], groupsStored, isOver },
});

const held = ({ stored }: SlotBook): string => stored.map(({ slot, name }) => `${slot} ${name}`).join(', ');
const waiting = ({ begun }: SlotBook): readonly number[] => begun.map(({ slot }) => slot);

test('what is stored while it goes on is in the book at once, the rest waits', () => {
  expect(withDownload(BOOK, latest(0, false), [9])).toBe(BOOK);
  const after = withDownload(BOOK, latest(1, false), [5]);
  expect([held(after), waiting(after)]).toEqual(['5 Old, 9 New, 12 Old', [5, 12]]);
  expect(withDownload(after, latest(1, false), [5])).toBe(after);
});

test('at its end the broken one is not known, and behind it the old ones are still there', () => {
  const after = withDownload(BOOK, latest(1, true), [5]);
  expect([held(after), waiting(after)]).toEqual(['9 New, 12 Old', []]);
  const done = withDownload(BOOK, latest(3, true), []);
  expect([held(done), waiting(done)]).toEqual(['5 New, 9 New, 12 New', []]);
});

test('called off between two groups, none is lost', () => {
  const after = withDownload(BOOK, latest(2, true), []);
  expect([held(after), waiting(after)]).toEqual(['5 New, 9 New, 12 Old', []]);
});

test('of a download that was not reported, what stands before a broken slot has arrived', () => {
  for (const download of [null, { ...latest(3, true), slots: [1, 2] }]) {
    expect(held(withDownload(BOOK, download, [5]))).toBe('9 New, 12 Old');
    expect(held(withDownload(BOOK, download, [9]))).toBe('5 Old, 12 Old');
    expect(held(withDownload(BOOK, download, []))).toBe('9 New');
  }
});

test('news are about what is on its way, or about nothing here', () => {
  expect(concerns(latest(0, false), BOOK)).toBe(true);
  expect(concerns(latest(0, false), BEFORE)).toBe(false);
  expect(concerns({ ...latest(0, false), slots: [9, 5] }, BOOK)).toBe(false);
  expect(withDownload(BEFORE, latest(3, true), [])).toBe(BEFORE);
});
