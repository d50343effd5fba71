// The library of action groups: the group that is shown is always one of it, and each settled change goes there by itself.
// Nothing is lost: until the keeper has a text it waits in the browser's storage, and of two that were changed at the same
// time both are kept. Never moves the robot.

import { createStore, type StoreApi } from 'zustand/vanilla';
import { sleep, type Clock } from '#shared/clock.ts';
import { emptyGroup, type ActionGroup, groupFromText, groupToText } from '#shared/group/group.ts';
import { rename } from '#shared/group/groupEdits.ts';
import type { Label } from '#shared/document/history.ts';
import { factsOf } from '#shared/files/facts.ts';
import type { GroupFacts } from '#shared/files/factsSchema.ts';
import {
  asLibraryError,
  listedOf,
  type DocumentStore,
  type Listed,
  type Listing,
  type Stored,
  type LibraryErrorCode,
} from '#shared/files/documentStore.ts';
import { libraryProblem } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import type { Document } from '../groupDocument.ts';
import type { TextStorage } from '../../state/soon.ts';
import type { Notices } from '../../state/notices.ts';
import type { RobotStore } from '../profiles/robots.ts';
import type { View } from '../view.ts';
import { longerName } from '../../state/longerName.ts';
import { groupOf, createOpenDocument, unchanged } from './openDocument.ts';
import type { LibraryFilesOptions } from './libraryFiles.ts';
import { createLibraryVersions, type LibraryVersions } from './libraryVersions.ts';
import { createOutbox, createDocumentChanges } from './outbox.ts';

export interface LibraryState {
  /** Where it lies; null until that is known. */
  readonly place: DocumentStore['place'] | null;
  /** Those in the trash too, in no order. */
  readonly documents: readonly Listed[];
  /** How often it has been listed: what the list does not say, as versions, may have changed as well. */
  readonly listings: number;
  readonly openId: string;
  /** The keeper has every change. */
  readonly isSaved: boolean;
}

/** What cannot be done is told to the person; nothing rejects. */
export interface Library extends LibraryVersions {
  readonly store: StoreApi<LibraryState>;
  /** What `createLibraryFiles` needs of it: files come with the panel that opens and saves them. */
  readonly forFiles: LibraryFilesOptions;
  /** Looks what others have changed; the group that is shown follows, if nothing of it waits here. */
  refresh(): Promise<void>;
  create(): void;
  /**
   * Keeps a group as a new document, without showing it. Resolves once the library has it, or does not take it soon: then it
   * waits here.
   */
  add(group: ActionGroup): Promise<void>;
  open(id: string): Promise<void>;
  /** Null where it cannot be read. */
  group(id: string): Promise<ActionGroup | null>;
  duplicate(id: string): Promise<void>;
  /** Changes any document; the one that is shown undoably. */
  change(id: string, label: Label, edit: (group: ActionGroup) => ActionGroup): Promise<void>;
  remove(id: string): Promise<void>;
  restore(id: string): Promise<void>;
}

/** How long somebody who adds many groups waits for each. */
const ADDED_WITHIN_MS = 700;

/** Over as soon as nothing waits here any more. */
const WAITING: readonly LibraryErrorCode[] = ['full', 'busy', 'unreachable'];

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
  const outbox = createOutbox(storage, (isWritten) => {
    isHeldHere = isWritten;
    tellHeld();
  });
  const opened = createOpenDocument(document, storage, newId);
  const store = createStore<LibraryState>(() => ({
    ...{ place: null, documents: [], listings: 0, openId: opened.id(), isSaved: true },
  }));
  const shown = (): ActionGroup => document.store.getState().present;
  /** What waits or is kept already; anything else that is shown is a change. */
  let noted = shown();
  /** In the outbox, or not to be there. */
  let isWritten = true;
  let isShowing = false;
  const notifiedDamage = new Set<string>();
  let isFound = true;
  /** The library did not take the last group in time: nobody waits for it until it has everything. */
  let isBehind = false;
  /** This browser's storage took the last change of what waits. */
  let isHeldHere = true;
  let isStoreAway = false;

  const documentChanges = createDocumentChanges({
    ...{ documentStore: options.documentStore, outbox, clock: options.clock },
    factsOf: factsOfText,
    onSaved(id, revision) {
      opened.setRevision(id, revision);
      notifySaved();
      if (outbox.entries().length > 0) return;
      isBehind = isStoreAway = false;
      tellHeld();
      for (const code of WAITING) notices.takeBack(libraryProblem(code, ''));
    },
    onConflict: keepBoth,
    onFailure(error) {
      tell(error);
      isStoreAway = true;
      tellHeld();
    },
  });

  function factsOfText(text: string): GroupFacts | null {
    const read = groupFromText(text);
    if ('problem' in read) return null;
    return factsOf(read.value, { updatedAtMs: epochMs(), robot: robots.current().robot.name });
  }

  /** A change that is nowhere but in this page: for a moment always, but not for as long as the library is away. */
  function tellHeld(): void {
    if (isHeldHere || !isStoreAway) notices.takeBack(words.library.notHeldHere);
    else notices.tell('warning', words.library.notHeldHere);
  }

  function tell(error: unknown): void {
    const { code, message } = asLibraryError(error);
    notices.tell('warning', libraryProblem(code, message));
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
    if (isShowing || gesture !== null || present === noted) return;
    noted = present;
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

  /** The newer text stays under its name; ours goes on as a document of its own. */
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
    notices.tell('warning', words.library.conflict({ name: ours.name, copy }));
  }

  /** As it is here, if something of it waits here; else as the keeper has it. */
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
    noted = shown();
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

  /** Where the disk has damaged what is kept, `instead` takes its place. */
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

  /** Each once. */
  function tellDamage({ damagedFile, changesLost }: Listing): void {
    const damage = damagedFile === null ? [] : [words.library.damagedFile({ file: damagedFile })];
    if (changesLost) damage.push(words.library.changesLost);
    for (const text of damage.filter((text) => !notifiedDamage.has(text))) {
      notifiedDamage.add(text);
      notices.tell('warning', text);
    }
  }

  async function refresh(): Promise<void> {
    const documentStore = await options.documentStore;
    const listing = await documentStore.list();
    const documents = listedOf(listing, 'group');
    tellDamage(listing);
    const { documents: before, listings } = store.getState();
    const shared = unchanged(before, documents);
    store.setState({ place: documentStore.place, documents: shared, listings: listings + 1 });
    await follow(shared);
  }

  /** What is shown follows the keeper, unless a change of it waits here. */
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

  /** Asked for again and again: a keeper that stays away is told of once. */
  async function look(): Promise<void> {
    try {
      await flushAndRefresh();
      isFound = true;
    } catch (error) {
      if (isFound) tell(error);
      isFound = false;
    }
  }

  async function remove(id: string): Promise<void> {
    const { name } = await read(id);
    await settle();
    const wasOpen = id === opened.id();
    await (await options.documentStore).remove([id]);
    if (wasOpen) create();
    const undo = (): void => void attempt(restore(id).then(() => (wasOpen ? open(id) : undefined)));
    notices.tell('info', words.library.removed({ name }), { label: words.library.undo, act: undo });
    await refresh();
  }

  async function restore(id: string): Promise<void> {
    await (await options.documentStore).restore([id]);
    await refresh();
  }

  async function start(): Promise<void> {
    const waiting = outbox.entries().map(([id, { text }]) => ({ id, text }));
    const own = waiting.find(({ id }) => id === opened.id());
    if (own !== undefined && own.text !== groupToText(shown())) show(own.id, groupOf(own.text));
    else if (own === undefined && !opened.wasRemembered && shown().frames.length > 0)
      put(opened.id(), groupToText(shown()));
    notifySaved();
    if (!(await flush())) return;
    if (waiting.length > 0)
      notices.tell(
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
