// Which slot of a board a group takes: its own, the one that has it already, or a free one. Free is what nothing is known to be in and
// what no board plays unasked. Pure; knows no session.

import type { Range } from '../codec/families.ts';
import { isLiveSlot } from '../codec/slotMeanings.ts';
import type { ActionGroup } from './group.ts';
import type { SlotBook, VersionsTold } from './slotBook.ts';

export interface KnownSlots {
  readonly book: Pick<SlotBook, 'stored' | 'erased'>;
  /** What others stored, as a shared link has it. */
  readonly versions: VersionsTold;
  /** They hold half a group, which somebody may want to download again. */
  readonly broken: readonly number[];
  readonly range: Range;
}

/** The one that the group names, else the one that got it last, be it erased since; null where the board has no such slot, or there is none. */
export function ownSlot(
  documentId: string,
  { slot }: Pick<ActionGroup, 'slot'>,
  { book, versions, range }: KnownSlots,
): number | null {
  const latestOf = (records: SlotBook['stored']): number | undefined =>
    records
      .filter((record) => record.documentId === documentId)
      .toSorted((one, other) => other.storedAtMs - one.storedAtMs)
      .at(0)?.slot;
  const byOthers = Object.keys(versions).find((key) => versions[Number(key)]?.documentId === documentId);
  const there = latestOf(book.stored) ?? (byOthers === undefined ? undefined : Number(byOthers));
  const own = slot ?? there ?? latestOf(book.erased) ?? null;
  return own !== null && own >= range.min && own <= range.max ? own : null;
}

/** `taken`: where other groups shall go. null: no slot is free. */
export function freeSlot(known: KnownSlots, taken: readonly number[] = []): number | null {
  const full = new Set([
    ...taken,
    ...known.broken,
    ...known.book.stored.map(({ slot }) => slot),
    ...Object.keys(known.versions).map(Number),
  ]);
  return slotsFor(known.range).find((slot) => !full.has(slot)) ?? null;
}

/** The group's own, else a free one; where none is free, the first that may be replaced. */
export function slotFor(own: number | null, known: KnownSlots, taken: readonly number[] = []): number {
  return own ?? freeSlot(known, taken) ?? slotsFor(known.range)[0] ?? known.range.min;
}

const slotsFor = ({ min, max }: Range): readonly number[] =>
  Array.from({ length: max - min + 1 }, (_, index) => min + index).filter((slot) => !isLiveSlot(slot));
