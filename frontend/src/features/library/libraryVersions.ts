// Named versions of a group: saving, renaming, deleting and restoring one. Failures become notices; no promise rejects.

import { type ActionGroup, groupToText } from '#shared/group/group.ts';
import type { DocumentStore, Version } from '#shared/files/documentStore.ts';
import { words } from '../../i18n/words.ts';
import type { Document } from '../groupDocument.ts';
import type { Notices } from '../../state/notices.ts';
import { groupOf } from './openDocument.ts';

export interface LibraryVersions {
  versions(id: string): Promise<readonly Version[]>;
  keepVersion(id: string, name: string): Promise<void>;
  /** Its notice offers Undo. */
  renameVersion(id: string, version: Version, name: string): Promise<void>;
  /** Its notice offers Undo. */
  removeVersion(id: string, version: Version): Promise<void>;
  /** Opens the document and replaces it with that version, as an undo step. */
  restoreVersion(id: string, version: Version): Promise<void>;
}

interface LibraryVersionsOptions {
  readonly documentStore: Promise<DocumentStore>;
  readonly document: Document;
  readonly notices: Notices;
  /** Milliseconds since 1970. */
  epochMs(): number;
  newId(): string;
  /** Reports a failure as a notice. */
  attempt(work: Promise<void>): Promise<void>;
  read(id: string): Promise<ActionGroup>;
  /** `instead` replaces the text if the stored one is damaged. */
  open(id: string, instead: ActionGroup): Promise<void>;
  /** Resolves when the document store has every change; rejects if it refuses one. */
  settle(): Promise<void>;
  refresh(): Promise<void>;
}

export function createLibraryVersions(options: LibraryVersionsOptions): LibraryVersions {
  const { document, notices, epochMs, newId, attempt, read, open, settle, refresh } = options;

  async function versions(id: string): Promise<readonly Version[]> {
    let found: readonly Version[] = [];
    await attempt(
      options.documentStore.then(async (documentStore) => void (found = await documentStore.versions(id))),
    );
    return found;
  }

  async function keepVersion(id: string, name: string): Promise<void> {
    const text = groupToText(await read(id));
    await settle();
    await (await options.documentStore).keepVersion(id, { id: newId(), name, atMs: epochMs() }, text);
    notices.say(words.library.versionSaved({ name }));
    await refresh();
  }

  async function renameVersion(id: string, version: Version, name: string): Promise<void> {
    const documentStore = await options.documentStore;
    const text = await documentStore.readVersion(id, version.id);
    await documentStore.keepVersion(id, { ...version, name }, text);
    tellUndoably(words.library.versionRenamed({ name: version.name, wanted: name }), () =>
      documentStore.keepVersion(id, version, text),
    );
    await refresh();
  }

  async function removeVersion(id: string, version: Version): Promise<void> {
    const documentStore = await options.documentStore;
    const text = await documentStore.readVersion(id, version.id);
    await documentStore.removeVersion(id, version.id);
    tellUndoably(words.library.versionRemoved({ name: version.name }), () =>
      documentStore.keepVersion(id, version, text),
    );
    await refresh();
  }

  function tellUndoably(text: string, undo: () => Promise<void>): void {
    const act = (): void => void attempt(undo().then(refresh));
    notices.show('info', text, { label: words.library.undo, act });
  }

  async function restoreVersion(id: string, { id: version, name }: Version): Promise<void> {
    const group = groupOf(await (await options.documentStore).readVersion(id, version));
    await open(id, group);
    document.edit(
      () => words.library.steps.version({ name }),
      () => group,
    );
  }

  return {
    versions,
    keepVersion: (id, name) => attempt(keepVersion(id, name)),
    renameVersion: (id, version, name) => attempt(renameVersion(id, version, name)),
    removeVersion: (id, version) => attempt(removeVersion(id, version)),
    restoreVersion: (id, version) => attempt(restoreVersion(id, version)),
  };
}
