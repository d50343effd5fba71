// The library of action groups. The open group is always a document of the library, and each complete change is saved to it. Nothing is
// lost: a change waits in the browser's storage until the document store has it, and a conflict keeps both versions. Never moves the
// robot.

import { createStore, type StoreApi } from 'zustand/vanilla';
import { sleep, type Clock } from '#shared/clock.ts';
import {
  emptyGroup,
  type ActionGroup,
  groupFromText,
  groupToText,
  holdsMotion,
} from '#shared/group/group.ts';
import { rename } from '#shared/group/groupEdits.ts';
import type { Label } from '#shared/document/history.ts';
import { factsOf, type GroupFacts } from '#shared/files/facts.ts';
import {
  asLibraryError,
  listedOf,
  type DocumentStore,
  type Listed,
  type Stored,
} from '#shared/files/documentStore.ts';
import { longerName } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import type { Document } from '../groupDocument.ts';
import type { TextStorage } from '../../state/storage.ts';
import type { Notices } from '../../state/notices.ts';
import type { RobotStore } from '../profiles/robots.ts';
import type { View } from '../view.ts';
import { groupOf, createOpenDocument, unchanged } from './openDocument.ts';
import type { LibraryFilesOptions } from './libraryFiles.ts';
import { createLibraryNotices } from './libraryNotices.ts';
import { createLibraryVersions, type LibraryVersions } from './libraryVersions.ts';
import { createOutbox, createDocumentChanges } from './outbox.ts';

export interface LibraryState {
  /** Where the documents are stored; null until that is known. */
  readonly place: DocumentStore['place'] | null;
  /** Includes documents in the trash; unordered. */
  readonly documents: readonly Listed[];
  /** Counts listings, because data that is not in the list, such as versions, may have changed as well. */
  readonly listings: number;
  readonly openId: string;
  /** The document store has every change. */
  readonly isSaved: boolean;
}

/** Failures become notices; no promise rejects. */
export interface Library extends LibraryVersions {
  readonly store: StoreApi<LibraryState>;
  /** Arguments for `createLibraryFiles`, which is loaded with the panel for files. */
  readonly forFiles: LibraryFilesOptions;
  /** Lists the library again. The open group follows changes of other people unless it has unsaved changes. */
  refresh(): Promise<void>;
  create(): void;
  /** Adds a group as a new document without opening it. Resolves once it is saved, or after a while: then it waits in the outbox. */
  add(group: ActionGroup): Promise<void>;
  open(id: string): Promise<void>;
  /** null if it cannot be read. */
  group(id: string): Promise<ActionGroup | null>;
  duplicate(id: string): Promise<void>;
  /** Changes any document; for the open one this is an undo step. */
  change(id: string, label: Label, edit: (group: ActionGroup) => ActionGroup): Promise<void>;
  remove(id: string): Promise<void>;
  restore(id: string): Promise<void>;
}

/** The longest wait for each group while many are added. */
const ADDED_WITHIN_MS = 700;

export interface LibraryOptions {
  readonly documentStore: Promise<DocumentStore>;
  readonly document: Document;
  readonly storage: TextStorage;
  readonly notices: Notices;
  readonly robots: RobotStore;
  readonly view: View;
  readonly clock: Clock;
  /** Milliseconds since 1970. */
  epochMs(): number;
  newId(): string;
}

export function createLibrary(options: LibraryOptions): Library {
  const { document, storage, notices, robots, view, epochMs, newId } = options;
  const own = createLibraryNotices(notices);
  const { tell } = own;
  const outbox = createOutbox(storage, own.setOutboxStored);
  const opened = createOpenDocument(document, storage, newId);
  const store = createStore<LibraryState>(() => ({
    ...{ place: null, documents: [], listings: 0, openId: opened.id(), isSaved: true },
  }));
  const shown = (): ActionGroup => document.store.getState().present;
  /** The value of the open group that is saved or in the outbox; any other value is a change. */
  let savedGroup = shown();
  /** The open group has no change that is missing in the outbox. */
  let isWritten = true;
  let isShowing = false;
  /** The library did not take the last group in time: `add` does not wait until everything is saved. */
  let isBehind = false;

  const documentChanges = createDocumentChanges({
    ...{ documentStore: options.documentStore, outbox, clock: options.clock },
    factsOf: factsOfText,
    onSaved(id, revision) {
      opened.setRevision(id, revision);
      notifySaved();
      if (outbox.entries().length > 0) return;
      isBehind = false;
      own.setSaved();
    },
    onConflict: keepBoth,
    onFailure: own.setAway,
  });

  function factsOfText(text: string): GroupFacts | null {
    const read = groupFromText(text);
    if ('problem' in read) return null;
    return factsOf(read.value, { updatedAtMs: epochMs(), robot: robots.current().robot.name });
  }

  const attempt = (work: Promise<void>): Promise<void> => work.catch(tell);

  document.onSave((text) => {
    if (isWritten) return;
    isWritten = true;
    outbox.put(opened.id(), { text, revision: opened.revisionOf(opened.id()) });
    documentChanges.soon();
  });

  const notifySaved = (): void =>
    store.setState({ openId: opened.id(), isSaved: isWritten && outbox.entries().length === 0 });

  function put(id: string, text: string): void {
    outbox.put(id, { text, revision: opened.revisionOf(id) });
    documentChanges.soon();
    notifySaved();
  }

  document.store.subscribe(({ present, gesture }) => {
    if (isShowing || gesture !== null || present === savedGroup) return;
    savedGroup = present;
    isWritten = false;
    notifySaved();
  });

  function unsavedOf(id: string): Stored | undefined {
    document.flush();
    return outbox.get(id);
  }

  function flush(): Promise<boolean> {
    document.flush();
    return documentChanges.flush();
  }

  function settle(): Promise<void> {
    document.flush();
    return documentChanges.settle();
  }

  /** The newer text keeps the document; ours becomes a new document. */
  function keepBoth(id: string, { text }: Stored): void {
    const ours = groupOf(text);
    const copy = longerName(ours.name, words.library.otherVersion);
    const copyId = newId();
    if (id === opened.id()) {
      opened.become(copyId);
      document.edit(
        () => words.library.steps.rename,
        (group) => rename(group, copy),
      );
      put(copyId, groupToText(shown()));
    } else put(copyId, groupToText(rename(ours, copy)));
    notices.show('warning', words.library.conflict({ name: ours.name, copy }));
  }

  /** The group with its unsaved changes, if any; otherwise from the document store. */
  async function read(id: string): Promise<ActionGroup> {
    if (id === opened.id()) return shown();
    const unsaved = unsavedOf(id);
    if (unsaved !== undefined) return groupOf(unsaved.text);
    const { text, revision } = await (await options.documentStore).read(id);
    opened.setRevision(id, revision);
    return groupOf(text);
  }

  function show(id: string, group: ActionGroup): void {
    document.flush();
    isShowing = true;
    opened.show(id, group, () => words.library.steps.elsewhere);
    isShowing = false;
    savedGroup = shown();
    view.setState({ selectedFrame: null });
    notifySaved();
  }

  function create(): void {
    const { robot } = robots.current();
    const group = emptyGroup(words.actions.defaultName, document.store.getState().present.unit);
    show(newId(), { ...group, robot: robot.name });
  }

  async function add(group: ActionGroup): Promise<void> {
    put(newId(), groupToText(group));
    const late = sleep(options.clock, isBehind ? 0 : ADDED_WITHIN_MS).then(() => false);
    isBehind = !(await (isBehind ? late : Promise.race([flush(), late])));
  }

  /** `instead` replaces the text if the stored one is damaged. */
  async function open(id: string, instead?: ActionGroup): Promise<void> {
    if (id === opened.id()) return;
    const group = await read(id).catch((error: unknown) => {
      const listed = store.getState().documents.find((one) => one.id === id);
      if (asLibraryError(error).code !== 'damaged' || !instead || !listed) throw error;
      opened.setRevision(id, listed.revision);
      put(id, groupToText(instead));
      return instead;
    });
    show(id, group);
  }

  async function refresh(): Promise<void> {
    const documentStore = await options.documentStore;
    const listing = await documentStore.list();
    const documents = listedOf(listing, 'group');
    own.tellDamage(listing);
    const { documents: before, listings } = store.getState();
    const shared = unchanged(before, documents);
    store.setState({ place: documentStore.place, documents: shared, listings: listings + 1 });
    await follow(shared);
  }

  /** Updates the open group from the document store, unless it has unsaved changes. */
  async function follow(documents: readonly Listed[]): Promise<void> {
    const id = opened.id();
    const listed = documents.find((one) => one.id === id);
    if (unsavedOf(id) !== undefined) return;
    if (listed === undefined && opened.revisionOf(id) > 0) put(id, groupToText(shown()));
    if (listed === undefined || listed.revision === opened.revisionOf(id)) return;
    const { text, revision } = await (await options.documentStore).read(id);
    const { gesture } = document.store.getState();
    if (id !== opened.id() || gesture !== null || unsavedOf(id) !== undefined) return;
    opened.setRevision(id, revision);
    show(id, groupOf(text));
  }

  async function change(id: string, label: Label, edit: (group: ActionGroup) => ActionGroup): Promise<void> {
    if (id === opened.id()) document.edit(label, edit);
    else put(id, groupToText(edit(await read(id))));
    await flushAndRefresh();
  }

  async function flushAndRefresh(): Promise<void> {
    if (await flush()) await refresh();
  }

  async function look(): Promise<void> {
    try {
      await flushAndRefresh();
      own.tellListing(null);
    } catch (error) {
      own.tellListing(error);
    }
  }

  async function remove(id: string): Promise<void> {
    const { name } = await read(id);
    await settle();
    const wasOpen = id === opened.id();
    await (await options.documentStore).remove([id]);
    if (wasOpen) create();
    const undo = (): void => void attempt(restore(id).then(() => (wasOpen ? open(id) : undefined)));
    notices.show('info', words.library.removed({ name }), { label: words.library.undo, act: undo });
    await refresh();
  }

  async function restore(id: string): Promise<void> {
    await (await options.documentStore).restore([id]);
    await refresh();
  }

  async function start(): Promise<void> {
    const waiting = outbox.entries().map(([id, { text }]) => ({ id, text }));
    const current = waiting.find(({ id }) => id === opened.id());
    if (current !== undefined && current.text !== groupToText(shown()))
      show(current.id, groupOf(current.text));
    else if (current === undefined && !opened.wasRemembered && holdsMotion(shown()))
      put(opened.id(), groupToText(shown()));
    notifySaved();
    if (!(await flush())) return;
    if (waiting.length > 0)
      notices.show(
        'info',
        words.library.recovered({
          names: words.numbers.formatNames(waiting.map(({ text }) => groupOf(text).name)),
        }),
      );
    await refresh();
  }

  void attempt(start());

  return {
    forFiles: {
      ...{
        documentStore: options.documentStore,
        clock: options.clock,
        notices,
        newId,
        tell,
        refresh,
        settle,
      },
      factsOf: (group, updatedAtMs) => factsOf(group, { updatedAtMs, robot: '' }),
    },
    ...createLibraryVersions({
      ...{ documentStore: options.documentStore, document, notices, epochMs, newId },
      ...{ attempt, read, open, settle, refresh },
    }),
    store,
    refresh: look,
    create,
    add,
    open: (id) => attempt(open(id)),
    group: (id) =>
      read(id).catch((error: unknown) => {
        tell(error);
        return null;
      }),
    change: (id, label, edit) => attempt(change(id, label, edit)),
    duplicate: (id) =>
      attempt(
        read(id).then((group) => {
          put(newId(), groupToText(rename(group, longerName(group.name, words.library.copyOf))));
          return flushAndRefresh();
        }),
      ),
    remove: (id) => attempt(remove(id)),
    restore: (id) => attempt(restore(id)),
  };
}
