// Exports the whole library to a file, and imports one: completely or not at all, beside the existing documents. Knows no document store.

import type { Clock } from '#shared/clock.ts';
import { type ActionGroup, groupToText, sameGroup } from '#shared/group/group.ts';
import type { GroupFacts } from '#shared/files/facts.ts';
import {
  asLibraryError,
  LibraryError,
  listedOf,
  type DocumentStore,
  type LibraryErrorCode,
  type Listed,
} from '#shared/files/documentStore.ts';
import {
  libraryFromText,
  libraryToText,
  type BundledDocument,
  type BundledVersion,
} from '#shared/files/libraryText.ts';
import { flawSentence, libraryProblem } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import type { Notices } from '../../state/notices.ts';
import { groupOf } from './openDocument.ts';

export interface LibraryFiles {
  /** null if it failed; then a notice says why. */
  exportText(): Promise<string | null>;
  importText(text: string): Promise<void>;
}

export interface LibraryFilesOptions {
  readonly documentStore: Promise<DocumentStore>;
  readonly notices: Notices;
  factsOf(group: ActionGroup, updatedAtMs: number): GroupFacts;
  newId(): string;
  readonly clock: Clock;
  tell(error: unknown): void;
  refresh(): Promise<void>;
  /** Resolves when the document store has every change; rejects if it refuses one. */
  settle(): Promise<void>;
}

/** After this time a notice says that the work continues. */
const PATIENCE_MS = 700;

type Outcome = 'added' | 'changed' | 'same';

export function createLibraryFiles(options: LibraryFilesOptions): LibraryFiles {
  const { notices, newId, tell } = options;

  async function exportText(): Promise<string | null> {
    await options.settle();
    const documentStore = await options.documentStore;
    const documents = listedOf(await documentStore.list(), 'group');
    const stored = documents.filter(({ isRemoved }) => !isRemoved);
    const read = await Promise.all(stored.map((document) => bundle(documentStore, document)));
    const bundled = read.flatMap(({ bundled: one }) => one ?? []);
    const lost = read.flatMap((one) => one.lost);
    const [first] = lost;
    if (bundled.length === 0 && first !== undefined) throw first.error;
    notices.show('info', words.library.exported({ count: bundled.length }));
    if (first !== undefined)
      notices.show(
        'warning',
        words.library.notExported({ names: words.numbers.formatNames(lost.map(({ name }) => name)) }),
      );
    return libraryToText({ documents: bundled });
  }

  async function take(documents: readonly BundledDocument[]): Promise<void> {
    await options.settle();
    const documentStore = await options.documentStore;
    const present = listedOf(await documentStore.list(), 'group');
    const outcomes: Outcome[] = [];
    const staged: string[] = [];
    for (const document of documents) {
      const { outcome, id } = await outcomeOf(documentStore, present, document);
      outcomes.push(outcome);
      staged.push(id);
      if (outcome !== 'same') await stage(documentStore, id, document);
    }
    // So far all imported documents are in the trash: now they appear together, or not at all.
    await documentStore.restore(staged);
    const count = (outcome: Outcome): number => outcomes.filter((one) => one === outcome).length;
    notices.show(
      'info',
      words.library.imported({ added: count('added'), changed: count('changed'), same: count('same') }),
    );
    await options.refresh();
  }

  async function outcomeOf(
    documentStore: DocumentStore,
    present: readonly Listed[],
    { id, group }: BundledDocument,
  ): Promise<{ readonly outcome: Outcome; readonly id: string }> {
    if (!present.some((one) => one.id === id)) return { outcome: 'added', id };
    const found = await wholeOrNot(async () => groupOf((await documentStore.read(id)).text));
    return 'whole' in found && sameGroup(found.whole, group)
      ? { outcome: 'same', id }
      : { outcome: 'changed', id: newId() };
  }

  async function stage(documentStore: DocumentStore, id: string, document: BundledDocument): Promise<void> {
    const { group, updatedAtMs, versions } = document;
    const facts = options.factsOf(group, updatedAtMs);
    await documentStore.write(id, { text: groupToText(group), facts, expected: 0, isRemoved: true });
    for (const { name, atMs, group: stored } of versions)
      await documentStore.keepVersion(id, { id: newId(), name, atMs }, groupToText(stored));
  }

  return {
    exportText: () =>
      exportText().catch((error: unknown) => {
        tell(error);
        return null;
      }),
    async importText(text) {
      const read = libraryFromText(text);
      if ('problem' in read)
        notices.show('warning', words.library.notImported({ flaw: flawSentence(read.problem) }));
      else await whileReported(take(read.value.documents)).catch(tellNotImported);
    },
  };

  /** The document store may take long. */
  async function whileReported(taking: Promise<void>): Promise<void> {
    const waiting = words.library.importWaits;
    const leave = options.clock.after(PATIENCE_MS, () => notices.show('warning', waiting));
    await taking.finally(() => {
      leave();
      notices.takeBack(waiting);
    });
  }

  function tellNotImported(error: unknown): void {
    const { code, message } = asLibraryError(error);
    notices.show('warning', words.library.importFailed({ problem: libraryProblem(code, message) }));
  }
}

/** Leaves out damaged texts and names them. The newest intact version replaces a damaged group. */
async function bundle(documentStore: DocumentStore, { id, facts }: Listed): Promise<Bundling> {
  const { name, updatedAtMs } = facts;
  const read = await wholeOrNot(async () => groupOf((await documentStore.read(id)).text));
  const lost: Lost[] = [];
  const versions: BundledVersion[] = [];
  const listed = await wholeOrNot(() => documentStore.versions(id));
  if ('error' in listed) lost.push({ name: words.library.versionsOf({ name }), error: listed.error });
  for (const { id: version, ...stored } of 'whole' in listed ? listed.whole : []) {
    const found = await wholeOrNot(async () => groupOf(await documentStore.readVersion(id, version)));
    if ('whole' in found) versions.push({ ...stored, group: found.whole });
    else lost.push({ name: words.library.versionOf({ name, version: stored.name }), error: found.error });
  }
  if ('whole' in read) return { bundled: { id, updatedAtMs, group: read.whole, versions }, lost };
  const newest = versions.at(-1);
  const named = newest === undefined ? name : words.library.standsFor({ name, version: newest.name });
  lost.unshift({ name: named, error: read.error });
  return { bundled: newest ? { id, updatedAtMs, group: newest.group, versions } : null, lost };
}

interface Lost {
  readonly name: string;
  readonly error: LibraryError;
}

interface Bundling {
  readonly bundled: BundledDocument | null;
  readonly lost: readonly Lost[];
}

/** Errors of a single text: damaged, from a newer program, or deleted meanwhile. All others concern the library and are thrown. */
const OF_ONE_TEXT: ReadonlySet<LibraryErrorCode> = new Set(['damaged', 'unreadable', 'notFound']);

async function wholeOrNot<T>(
  read: () => Promise<T>,
): Promise<{ readonly whole: T } | { readonly error: LibraryError }> {
  try {
    return { whole: await read() };
  } catch (error) {
    if (error instanceof LibraryError && OF_ONE_TEXT.has(error.code)) return { error };
    throw error;
  }
}
