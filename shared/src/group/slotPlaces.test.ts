import fc from 'fast-check';
import { expect, test } from 'vitest';
import { FAMILIES, type FamilyId, slotTrigger } from '../codec/families.ts';
import { freeSlot, ownSlot, slotFor, type KnownSlots } from './slotPlaces.ts';
import type { SlotRecord } from './slotBook.ts';

const record = (slot: number, documentId: string, storedAtMs = 0): SlotRecord => ({
  ...{ slot, documentId, storedAtMs, name: documentId, fingerprint: '', frames: [] },
});
const knownOf = (change: Partial<KnownSlots>): KnownSlots => ({
  ...{ book: { stored: [], erased: [] }, versions: {}, broken: [], range: FAMILIES.doc.slot },
  ...change,
});

test('a group has the slot it names, else the one that got it last, from here or from others', () => {
  const stored = [record(3, 'wave', 10), record(40, 'wave', 20), record(50, 'bow', 30)];
  const erased = [record(3, 'nod', 40), record(70, 'wave', 50), record(8, 'gone', 10)];
  const known = knownOf({ book: { stored, erased }, versions: { 60: { version: '', documentId: 'nod' } } });
  expect(ownSlot('wave', { slot: 7 }, known)).toBe(7);
  expect(ownSlot('wave', { slot: null }, known)).toBe(40);
  expect(ownSlot('nod', { slot: null }, known)).toBe(60);
  expect(ownSlot('gone', { slot: null }, known), 'it can be restored there').toBe(8);
  expect(ownSlot('new', { slot: null }, known)).toBe(null);
  expect(ownSlot('wave', { slot: 255 }, knownOf({ range: FAMILIES['learm-esp32'].slot }))).toBe(null);
});

test('what is proposed holds nothing that is known, breaks nothing off, and is played by no pad, key or chain of any board', () => {
  const someSlots = fc.uniqueArray(fc.integer({ min: 0, max: 255 }), { maxLength: 256 });
  const someFamily = fc.constantFrom(...(Object.keys(FAMILIES) as FamilyId[]));
  fc.assert(
    fc.property(someSlots, someSlots, someSlots, someSlots, someFamily, (own, others, broken, taken, id) => {
      const known = knownOf({
        book: { stored: own.map((slot) => record(slot, 'wave')), erased: [] },
        versions: Object.fromEntries(others.map((slot) => [slot, { version: 'a', documentId: null }])),
        ...{ broken, range: FAMILIES[id].slot },
      });
      const slot = freeSlot(known, taken);
      const full = new Set([...own, ...others, ...broken, ...taken]);
      const { min, max } = known.range;
      const isFree = (one: number): boolean =>
        one > 20 && (one < 100 || one > 110) && one >= min && one <= max && !full.has(one);
      if (slot === null) expect(Array.from({ length: 256 }, (_, one) => one).filter(isFree)).toEqual([]);
      else {
        expect(isFree(slot)).toBe(true);
        for (const each of Object.keys(FAMILIES) as FamilyId[]) expect(slotTrigger(each, slot)).toBe(null);
      }
    }),
  );
});

test('where no slot is free, the first one that no pad plays is named: what it holds is asked about', () => {
  const stored = Array.from({ length: 256 }, (_, slot) => record(slot, 'wave'));
  expect(slotFor(null, knownOf({ book: { stored, erased: [] } }))).toBe(21);
  expect(slotFor(5, knownOf({ book: { stored, erased: [] } }))).toBe(5);
});
