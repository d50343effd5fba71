// What is remembered of one board's slots, because boards cannot be read: what was downloaded there from here, and what an erase
// took. Immutable; knows no storage, no session and no time of its own.

import * as v from 'valibot';
import type { Frame } from '../codec/commands.ts';
import { GROUP_NAME_LENGTH } from './group.ts';
import { readVersioned, versionedSchema, type Read, whole } from '../document/schema.ts';

const recordSchema = v.strictObject({
  slot: whole(0, 255),
  /** The group's. */
  name: v.pipe(v.string(), v.maxLength(GROUP_NAME_LENGTH)),
  /** The library's; books of earlier versions name none. */
  documentId: v.optional(v.string()),
  /** Since 1970. */
  storedAtMs: v.pipe(v.number(), v.finite()),
  by: v.optional(v.string()),
  /** Of the frames as the board got them, with the trims of that day. */
  fingerprint: v.string(),
  /** As the person means them: each is its duration, then servo and position by turns. */
  frames: v.array(v.pipe(v.array(whole(0, 0xffff)), v.minLength(1))),
});

const bookSchema = v.strictObject({
  stored: v.array(recordSchema),
  erased: v.array(recordSchema),
  /** Every other slot was empty then. */
  isEmptied: v.boolean(),
  /** Books of earlier versions name one, or none. */
  begun: v.optional(v.union([recordSchema, v.array(recordSchema)])),
});

const FORMAT = 'servodeck-slots';
const fileSchema = versionedSchema(FORMAT, bookSchema);

export interface SlotRecord {
  readonly slot: number;
  readonly name: string;
  /** Which document of the library it is; null where it was not noted. */
  readonly documentId: string | null;
  readonly storedAtMs: number;
  /** Another person, where it was not downloaded from here. */
  readonly by?: string;
  readonly fingerprint: string;
  readonly frames: readonly Frame[];
}

export interface SlotBook {
  /** By slot, ascending. */
  readonly stored: readonly SlotRecord[];
  /** What the last erase took and was not restored since. */
  readonly erased: readonly SlotRecord[];
  readonly isEmptied: boolean;
  /** What is on its way to the board, in this order: it may arrive when this page is closed. */
  readonly begun: readonly SlotRecord[];
}

/** What a gateway, which sees all downloads, knows of each slot, of those of others too. `version` is the fingerprint. */
export type StoredVersions = Readonly<
  Partial<Record<number, { readonly version: string; readonly documentId: string | null }>>
>;

export const EMPTY_SLOT_BOOK: SlotBook = { stored: [], erased: [], isEmptied: false, begun: [] };

export const recordOf = ({ stored }: SlotBook, slot: number): SlotRecord | undefined =>
  stored.find((record) => record.slot === slot);

const without = (records: readonly SlotRecord[], slot: number): readonly SlotRecord[] =>
  records.filter((record) => record.slot !== slot);

const bySlot = (one: SlotRecord, other: SlotRecord): number => one.slot - other.slot;

/** Of a slot that is in both, the newer. */
const joined = (records: readonly SlotRecord[], newer: readonly SlotRecord[]): readonly SlotRecord[] =>
  newer.reduce((sum, record) => [...without(sum, record.slot), record], records).toSorted(bySlot);

export function withStored(book: SlotBook, record: SlotRecord): SlotBook {
  return {
    ...book,
    stored: [...without(book.stored, record.slot), record].sort(bySlot),
    erased: without(book.erased, record.slot),
    begun: without(book.begun, record.slot),
  };
}

/** Something was stored there that this page does not know. */
export function withUnknown(book: SlotBook, slot: number): SlotBook {
  if (recordOf(book, slot) === undefined && !book.isEmptied) return book;
  return { ...book, stored: without(book.stored, slot), isEmptied: false };
}

/**
 * By the word of the gateway, which sees all downloads: where something else stands by now, what was there is gone; where nothing does,
 * it was erased elsewhere; and what an erase took stands there again.
 */
export function withVersions(book: SlotBook, versions: StoredVersions): SlotBook {
  const isThere = ({ slot, fingerprint }: SlotRecord): boolean => versions[slot]?.version === fingerprint;
  const isErased = ({ slot }: SlotRecord): boolean => versions[slot] === undefined;
  const [taken, back] = [book.stored.filter(isErased), book.erased.filter(isThere)];
  const stored = joined(book.stored.filter(isThere), back);
  const erased = joined(book.erased.filter(isErased), taken);
  const isEmptied = book.isEmptied && Object.keys(versions).length === stored.length;
  const isSame =
    [...taken, ...back].length === 0 &&
    stored.length === book.stored.length &&
    erased.length === book.erased.length;
  return isSame && isEmptied === book.isEmptied ? book : { ...book, stored, erased, isEmptied };
}

/** An erase has begun: it is unknown what is left. */
export function withErasing({ stored, erased, begun }: SlotBook): SlotBook {
  return { stored: [], erased: joined(erased, stored), isEmptied: false, begun };
}

export const withErased = (book: SlotBook): SlotBook => ({ ...book, isEmptied: true });

export type SlotContent = 'arriving' | 'broken' | 'same' | 'older' | 'other' | 'empty' | 'unknown';

/** What the session knows: slots with half a group, the one that is being filled, and what others have stored. */
export interface SlotsNow {
  readonly broken: readonly number[];
  readonly arriving: number | null;
  readonly versions: StoredVersions;
}

/** `group` is the open one, null where it cannot be on this board. */
export function contentOf(
  book: SlotBook,
  { broken, arriving, versions }: SlotsNow,
  slot: number,
  group: Pick<SlotRecord, 'documentId' | 'fingerprint'> | null,
): SlotContent {
  if (slot === arriving) return 'arriving';
  if (broken.includes(slot)) return 'broken';
  const record = recordOf(book, slot) ?? othersIn(versions, slot);
  if (record === undefined) return book.isEmptied ? 'empty' : 'unknown';
  if (record.fingerprint === group?.fingerprint) return 'same';
  // A name says nothing: it may change, and two groups may have the same.
  return record.documentId !== null && record.documentId === group?.documentId ? 'older' : 'other';
}

function othersIn(
  versions: StoredVersions,
  slot: number,
): Pick<SlotRecord, 'fingerprint' | 'documentId'> | undefined {
  const stored = versions[slot];
  return stored && { fingerprint: stored.version, documentId: stored.documentId };
}

/** What an erase takes and nothing here can bring back. Where a download broke off, what was there is gone already. */
export function notRestored(
  book: Pick<SlotBook, 'stored'>,
  {
    versions,
    broken,
  }: {
    readonly versions: Readonly<Partial<Record<number, { readonly name: string }>>>;
    readonly broken: readonly number[];
  },
): readonly Pick<SlotRecord, 'slot' | 'name'>[] {
  const restored = new Set([...broken, ...book.stored.map(({ slot }) => slot)]);
  return Object.entries(versions)
    .map(([slot, stored]) => ({ slot: Number(slot), name: stored?.name ?? '' }))
    .filter(({ slot }) => !restored.has(slot));
}

export function slotBookToText({ stored, erased, isEmptied, begun }: SlotBook): string {
  const packed = ({ documentId, ...record }: SlotRecord) => ({
    ...record,
    ...(documentId !== null && { documentId }),
    frames: record.frames.map(({ durationMs, targets }) => [
      durationMs,
      ...targets.flatMap(({ servo, position }) => [servo, position]),
    ]),
  });
  const content = {
    ...{ stored: stored.map(packed), erased: erased.map(packed), isEmptied },
    ...(begun.length > 0 && { begun: begun.map(packed) }),
  };
  return JSON.stringify({ format: FORMAT, version: 1, content });
}

export function slotBookFromText(text: string): Read<SlotBook> {
  const read = readVersioned(text, fileSchema, () => null);
  if ('problem' in read) return read;
  const { stored, erased, isEmptied, begun = [] } = read.value;
  const lists = { stored: stored.map(unpacked), erased: erased.map(unpacked) };
  return { value: { ...lists, isEmptied, begun: [begun].flat().map(unpacked) } };
}

function unpacked({ by, documentId, frames, ...record }: v.InferOutput<typeof recordSchema>): SlotRecord {
  const named = { documentId: documentId ?? null, ...(by !== undefined && { by }) };
  return { ...record, ...named, frames: frames.map(frameOf) };
}

function frameOf([durationMs = 0, ...pairs]: readonly number[]): Frame {
  const targets = pairs.flatMap((servo, index) => {
    const position = pairs[index + 1];
    return index % 2 === 0 && position !== undefined ? [{ servo, position }] : [];
  });
  return { durationMs, targets };
}
