// The whole library as one file, and a file into the library: all of it or nothing, beside what is there. Knows no place.

import type { Clock } from '#shared/clock.ts';
import type { ActionGroup } from '#shared/actions/group/group.ts';
import { groupToText, sameGroup } from '#shared/actions/group/groupText.ts';
import {
  asLibraryError,
  listedOf,
  type GroupFacts,
  type Keeper,
  type Listed,
} from '#shared/actions/library/keeper.ts';
import {
  libraryFromText,
  libraryToText,
  type BundledDocument,
  type BundledVersion,
} from '#shared/actions/library/libraryText.ts';
import { words } from '../../words/words.ts';
import type { Notices } from '../notices.ts';
import { groupOf } from './groupOf.ts';

export interface LibraryFiles {
  /** null where it failed; then the person was told why. */
  exportText(): Promise<string | null>;
  importText(text: string): Promise<void>;
}

export interface LibraryFilesOptions {
  readonly keeper: Promise<Keeper>;
  readonly notices: Notices;
  factsOf(group: ActionGroup, updatedAtMs: number): GroupFacts;
  newId(): string;
  readonly clock: Clock;
  tell(error: unknown): void;
  refresh(): Promise<void>;
  /** Until the keeper has every change; rejects where it does not take them. */
  settle(): Promise<void>;
}

/** As long as nobody wonders. */
const PATIENCE_MS = 700;

type Fate = 'added' | 'changed' | 'same';

export function createLibraryFiles(options: LibraryFilesOptions): LibraryFiles {
  const { notices, newId, tell } = options;

  async function exportText(): Promise<string | null> {
    await options.settle();
    const keeper = await options.keeper;
    const documents = listedOf(await keeper.list(), 'group');
    const kept = documents.filter(({ isRemoved }) => !isRemoved);
    const bundled = await Promise.all(kept.map((document) => bundle(keeper, document)));
    notices.tell('info', words.library.exported(bundled.length));
    return libraryToText({ documents: bundled });
  }

  async function take(documents: readonly BundledDocument[]): Promise<void> {
    await options.settle();
    const keeper = await options.keeper;
    const present = listedOf(await keeper.list(), 'group');
    const fates: Fate[] = [];
    const staged: string[] = [];
    for (const document of documents) {
      const { fate, id } = await fateOf(keeper, present, document);
      fates.push(fate);
      staged.push(id);
      if (fate !== 'same') await stage(keeper, id, document);
    }
    // Until here all of it lies in the trash: now it appears together, or never.
    await keeper.restore(staged);
    const count = (fate: Fate): number => fates.filter((one) => one === fate).length;
    notices.tell('info', words.library.imported(count('added'), count('changed'), count('same')));
    await options.refresh();
  }

  async function fateOf(
    keeper: Keeper,
    present: readonly Listed[],
    { id, group }: BundledDocument,
  ): Promise<{ readonly fate: Fate; readonly id: string }> {
    if (!present.some((one) => one.id === id)) return { fate: 'added', id };
    const { text } = await keeper.read(id);
    return sameGroup(groupOf(text), group) ? { fate: 'same', id } : { fate: 'changed', id: newId() };
  }

  async function stage(keeper: Keeper, id: string, document: BundledDocument): Promise<void> {
    const { group, updatedAtMs, versions } = document;
    const facts = options.factsOf(group, updatedAtMs);
    await keeper.write(id, { text: groupToText(group), facts, expected: 0, isRemoved: true });
    for (const { name, atMs, group: kept } of versions)
      await keeper.keepVersion(id, { id: newId(), name, atMs }, groupToText(kept));
  }

  return {
    exportText: () =>
      exportText().catch((error: unknown) => {
        tell(error);
        return null;
      }),
    async importText(text) {
      const read = libraryFromText(text);
      if ('problem' in read) notices.tell('warning', words.library.notImported(read.problem));
      else await whileToldOf(take(read.value.documents)).catch(tellNotImported);
    },
  };

  /** A keeper may let one wait long. */
  async function whileToldOf(taking: Promise<void>): Promise<void> {
    const waiting = words.library.importWaits;
    const leave = options.clock.after(PATIENCE_MS, () => notices.tell('warning', waiting));
    await taking.finally(() => {
      leave();
      notices.takeBack(waiting);
    });
  }

  function tellNotImported(error: unknown): void {
    const { code, message } = asLibraryError(error);
    notices.tell('warning', words.library.importFailed(code, message));
  }
}

async function bundle(keeper: Keeper, { id, facts }: Listed): Promise<BundledDocument> {
  const { text } = await keeper.read(id);
  const versions = await keeper.versions(id);
  const kept = versions.map(async ({ id: version, name, atMs }): Promise<BundledVersion> => ({
    ...{ name, atMs, group: groupOf(await keeper.readVersion(id, version)) },
  }));
  return { id, updatedAtMs: facts.updatedAtMs, group: groupOf(text), versions: await Promise.all(kept) };
}
