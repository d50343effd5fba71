// Which slot of a board a group takes: its own, the one that has it already, or a free one; and what becomes of groups on their
// way there, by what is known of the download. Pure; knows no session.

import { type Range, isLiveSlot } from '../codec/families.ts';
import type { ActionGroup } from './group.ts';
import { type SlotBook, type StoredVersions, withStored, withUnknown, type SlotRecord } from './slotBook.ts';

export interface KnownSlots {
  readonly book: Pick<SlotBook, 'stored' | 'erased'>;
  /** What others stored, as a shared link has it. */
  readonly versions: StoredVersions;
  /** They hold half a group, which a person may want to download again. */
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

// What becomes of groups on their way to the board, by the news of the download: the page that requested them may have
// been away.

/** The latest download, by whichever client. */
export interface LatestDownload {
  readonly slots: readonly number[];
  readonly groupsStored: number;
  readonly isOver: boolean;
}

interface Outcome {
  readonly arrived: readonly SlotRecord[];
  /** It is unknown what their slots hold now. */
  readonly lost: readonly SlotRecord[];
  readonly waiting: readonly SlotRecord[];
}

/** These are on their way: the first byte has left. */
export const withBegun = (book: SlotBook, begun: readonly SlotRecord[]): SlotBook => ({ ...book, begun });

export const concerns = ({ slots }: LatestDownload, { begun }: SlotBook): boolean =>
  begun.length > 0 && begun.every(({ slot }) => slots.includes(slot));

/** `news` null: no download was reported. `broken`: slots that hold half a group. */
export function withDownload(
  book: SlotBook,
  latest: LatestDownload | null,
  broken: readonly number[],
): SlotBook {
  const { begun } = book;
  if (begun.length === 0) return book;
  const isReported = latest !== null && concerns(latest, book);
  const { arrived, lost, waiting } = isReported
    ? reportedOutcome(begun, latest, broken)
    : assumedOutcome(begun, broken);
  if (waiting.length === begun.length) return book;
  const forgotten = lost.reduce((sum, { slot }) => withUnknown(sum, slot), book);
  return { ...arrived.reduce(withStored, forgotten), begun: waiting };
}

/** Behind the one that broke none was begun, and what such a slot held before it holds still. */
function reportedOutcome(
  begun: readonly SlotRecord[],
  latest: LatestDownload,
  broken: readonly number[],
): Outcome {
  const isStored = ({ slot }: SlotRecord): boolean => latest.slots.indexOf(slot) < latest.groupsStored;
  const others = begun.filter((record) => !isStored(record));
  return {
    arrived: begun.filter(isStored),
    lost: latest.isOver ? others.filter(({ slot }) => broken.includes(slot)) : [],
    waiting: latest.isOver ? [] : others,
  };
}

/**
 * They go one after the other: what stands before a broken one has arrived. Where none broke, the first one has, which was
 * under way; of the others it is unknown.
 */
function assumedOutcome(begun: readonly SlotRecord[], broken: readonly number[]): Outcome {
  const at = begun.findIndex(({ slot }) => broken.includes(slot));
  return at === -1
    ? { arrived: begun.slice(0, 1), lost: begun.slice(1), waiting: [] }
    : { arrived: begun.slice(0, at), lost: begun.slice(at, at + 1), waiting: [] };
}
