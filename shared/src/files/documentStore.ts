// Where documents are stored as texts: what a list says of each, revisions, a trash, named versions. One interface for every
// place they may lie, and the one rule about writing that all of them follow. Knows no group, no robot and no place.

import timings from '../../protocol/timings.json' with { type: 'json' };
import type { GroupFacts, RobotFacts } from './facts.ts';

/** What a list says of a document without reading it. */
export type Facts = GroupFacts | RobotFacts;

export interface Listed<F extends Facts = GroupFacts> {
  readonly id: string;
  readonly revision: number;
  readonly isRemoved: boolean;
  readonly facts: F;
}

export interface Listing {
  readonly documents: readonly Listed<Facts>[];
  /** The name of a damaged file that the store found and set apart; null for none. */
  readonly damagedFile: string | null;
  /** The last changes before the store's start may be missing. */
  readonly changesLost: boolean;
}

/** Those of one kind. */
export function listedOf<K extends Facts['kind']>(
  { documents }: Listing,
  kind: K,
): readonly Listed<Extract<Facts, { kind: K }>>[] {
  return documents.filter((one): one is Listed<Extract<Facts, { kind: K }>> => one.facts.kind === kind);
}

export interface Stored {
  readonly text: string;
  readonly revision: number;
}

export interface Writing {
  readonly text: string;
  readonly facts: Facts;
  /** The revision it was read at; 0 for a new one. */
  readonly expected: number;
  /** To the trash at once: several that shall appear together are written so, then restored together. */
  readonly isRemoved: boolean;
}

export interface Version {
  readonly id: string;
  readonly name: string;
  readonly atMs: number;
}

/** Everything rejects with a LibraryError. The writer names a new document, so that a repeated request makes no second one. */
export interface DocumentStore {
  readonly place: 'gateway' | 'browser';
  list(): Promise<Listing>;
  read(id: string): Promise<Stored>;
  /** The new revision, by `nextRevision`. */
  write(id: string, writing: Writing): Promise<number>;
  /** To the trash for 30 days: all or none. */
  remove(ids: readonly string[]): Promise<void>;
  /** Out of the trash: all or none. */
  restore(ids: readonly string[]): Promise<void>;
  /** Oldest first. */
  versions(id: string): Promise<readonly Version[]>;
  readVersion(id: string, version: string): Promise<string>;
  /** Instead of the one with that id, if there is one. */
  keepVersion(id: string, version: Version, text: string): Promise<void>;
  /** For good. */
  removeVersion(id: string, version: string): Promise<void>;
}

export const LIBRARY_ERROR_CODES = [
  'conflict', // another client has changed it since it was read
  'notFound', // the store does not have it
  'full', // no room where it is stored
  'busy', // another program holds the store's file
  'tooLarge', // more than a store takes
  'unreachable', // the gateway does not answer
  'damaged', // the disk has changed it; the message says which and what is whole
  'unreadable', // this version cannot read what is stored
  'failed', // anything else; the message says what
] as const;

export type LibraryErrorCode = (typeof LIBRARY_ERROR_CODES)[number];

export class LibraryError extends Error {
  override readonly name = 'LibraryError';
  constructor(
    readonly code: LibraryErrorCode,
    message: string,
    options?: { cause?: unknown },
  ) {
    super(message, options);
  }
}

export const asLibraryError = (error: unknown): LibraryError =>
  error instanceof LibraryError ? error : new LibraryError('failed', String(error), { cause: error });

export const TRASH_MS = timings.library.trashDays * 24 * 3600 * 1000;

/** The same text sent again is no conflict: the answer may have been lost. What is not there is taken in. */
export function nextRevision(stored: Stored | undefined, { text, expected }: Writing): number {
  if (stored?.text === text) return stored.revision;
  if (stored !== undefined && stored.revision !== expected)
    throw new LibraryError('conflict', 'another client has changed this document meanwhile');
  return expected + 1;
}

export function required<T>(found: T | undefined): T {
  if (found === undefined) throw new LibraryError('notFound', 'the library does not hold that');
  return found;
}
