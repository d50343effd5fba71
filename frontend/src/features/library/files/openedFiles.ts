// Opened files with the answers about them. Files are read and their groups imported one after the other, with progress, until a person
// cancels. A worker reads them, so that the page stays responsive. Knows no dialog.

import { createStore, type StoreApi } from 'zustand/vanilla';
import { holdsMotion, type ActionGroup } from '#shared/group/group.ts';
import type { Stores } from '../../stores.ts';
import { words } from '../../../i18n/whole.ts';
import { firstAnswers, type Answer, type AnsweredFile, type ReadyGroup } from './answers.ts';
import type { Reading } from '#shared/files/reading.ts';

type Needed = Pick<Stores, 'document' | 'library' | 'view' | 'notices'>;

export function takeGroup({ document, library, view, notices }: Needed, group: ActionGroup): void {
  if (holdsMotion(document.store.getState().present)) library.create();
  document.edit(
    () => words.files.step({ name: group.name }),
    () => group,
  );
  view.setState({ tab: 'actions', authoring: 'group', selectedFrame: null });
  notices.say(words.files.taken({ name: group.name, frames: group.frames.length }));
}

/** Adds each group to the library, one after the other, so that the page stays responsive, and opens the first. */
export async function takeGroups(
  stores: Needed,
  [group, ...others]: readonly ActionGroup[],
  { signal, onTaken }: Course,
): Promise<void> {
  if (group === undefined) return;
  takeGroup(stores, group);
  onTaken(0);
  let added = 0;
  for (const other of others) {
    if (signal.aborted) break;
    await stores.library.add(other);
    added += 1;
    onTaken(added);
  }
  if (added > 0) stores.notices.show('info', words.files.inLibrary({ count: added }));
}

export interface OpenedFile extends AnsweredFile {
  readonly name: string;
  /** Files that were chosen together have the same number. */
  readonly batch: number;
}

export interface Progress {
  readonly done: number;
  readonly total: number;
}

interface OpenedFilesState {
  /** The newest batch first. */
  readonly list: readonly OpenedFile[];
  /** null while nothing is being read. */
  readonly reading: Progress | null;
  /** The number of files that were not read when reading was cancelled last. */
  readonly unread: number;
  /** null while nothing is being imported. */
  readonly taking: Progress | null;
}

/** How the caller follows the import of several groups. */
interface Course {
  readonly signal: AbortSignal;
  onTaken(index: number): void;
}

export interface OpenedFiles {
  readonly store: StoreApi<OpenedFilesState>;
  open(files: readonly File[]): void;
  /** Files already read stay. */
  cancelReading(): void;
  /** Answers about the group at `index` of the file. */
  answer(id: number, index: number, change: Partial<Answer>): void;
  drop(id: number): void;
  /** A file leaves the list when all its groups are imported. True if all of them were. */
  take(
    ready: readonly ReadyGroup[],
    takeOver: (groups: readonly ActionGroup[], course: Course) => Promise<void>,
  ): Promise<boolean>;
  /** Groups that are not imported yet stay in the list. */
  cancelTaking(): void;
}

export function createOpenedFiles(reader: FileReader): OpenedFiles {
  const store = createStore<OpenedFilesState>(() => ({ list: [], reading: null, unread: 0, taking: null }));
  const queue: { readonly file: File; readonly batch: number }[] = [];
  let [batches, nextId] = [0, 1];
  let readingEnds = new AbortController();
  let takingEnds = new AbortController();

  const change = (changed: (list: readonly OpenedFile[]) => readonly OpenedFile[]): void =>
    store.setState(({ list }) => ({ list: changed(list) }));

  function open(files: readonly File[]): void {
    if (files.length === 0) return;
    const batch = (batches += 1);
    queue.push(...files.map((file) => ({ file, batch })));
    const { reading } = store.getState();
    const { done, total } = reading ?? { done: 0, total: 0 };
    store.setState({ reading: { done, total: total + files.length }, unread: 0 });
    if (reading === null) void readQueue();
  }

  async function readQueue(): Promise<void> {
    readingEnds = new AbortController();
    const { signal } = readingEnds;
    for (let next = queue.shift(); next !== undefined; next = queue.shift()) {
      const { file, batch } = next;
      const reading = await reader.read(file);
      if (signal.aborted) return;
      const id = nextId++;
      const read: OpenedFile = { id, batch, name: file.name, reading, answers: firstAnswers(reading) };
      store.setState(({ list, reading: progress }) => ({
        list: added(list, read),
        reading: progress && { ...progress, done: progress.done + 1 },
      }));
    }
    store.setState({ reading: null });
  }

  function cancelReading(): void {
    const { reading } = store.getState();
    if (reading === null) return;
    readingEnds.abort();
    reader.stop();
    queue.length = 0;
    store.setState({ reading: null, unread: reading.total - reading.done });
  }

  const drop = (id: number): void => change((list) => list.filter((one) => one.id !== id));

  return {
    ...{ store, open, cancelReading, drop },
    answer: (id, index, said) =>
      change((list) =>
        list.map((one) => (one.id === id ? { ...one, answers: answered(one.answers, index, said) } : one)),
      ),
    async take(ready, takeOver) {
      if (store.getState().taking !== null) return false;
      takingEnds = new AbortController();
      const { signal } = takingEnds;
      store.setState({ taking: { done: 0, total: ready.length } });
      const onTaken = (index: number): void => {
        store.setState({ taking: { done: index + 1, total: ready.length } });
        const file = ready[index]?.file;
        if (file !== undefined && file !== ready[index + 1]?.file) drop(file);
      };
      await takeOver(
        ready.map(({ group }) => group),
        { signal, onTaken },
      ).finally(() => store.setState({ taking: null }));
      return !signal.aborted;
    },
    cancelTaking: () => takingEnds.abort(),
  };
}

function added(list: readonly OpenedFile[], file: OpenedFile): readonly OpenedFile[] {
  const at = list.findIndex(({ batch }) => batch < file.batch);
  return list.toSpliced(at === -1 ? list.length : at, 0, file);
}

const answered = (before: readonly Answer[], index: number, said: Partial<Answer>): readonly Answer[] =>
  before.map((one, place) => (place === index ? { ...one, ...said } : one));

interface FileReader {
  read(file: File): Promise<Reading>;
  /** Ends the current reading; its promise stays pending. */
  stop(): void;
}

export function createFileReader(): FileReader {
  let started: Started | null = null;

  async function read(file: File): Promise<Reading> {
    started ??= start();
    const { worker, failed } = started;
    const { port1, port2 } = new MessageChannel();
    const answered = new Promise<Reading>((resolve) =>
      port1.addEventListener('message', ({ data }: MessageEvent<Reading>) => resolve(data), { once: true }),
    );
    port1.start();
    worker.postMessage(file, [port2]);
    return Promise.race([answered, failed]).finally(() => port1.close());
  }

  return {
    read: (file) => read(file).catch(async () => (await import('./means.ts')).readFile(file)),
    stop() {
      started?.worker.terminate();
      started = null;
    },
  };
}

interface Started {
  readonly worker: Worker;
  /** Rejects if the worker cannot be loaded. */
  readonly failed: Promise<never>;
}

function start(): Started {
  const worker = new Worker(new URL('./readingWorker.ts', import.meta.url), { type: 'module' });
  const failed = new Promise<never>((_, reject) =>
    worker.addEventListener('error', () => reject(new Error('the worker that reads files failed')), {
      once: true,
    }),
  );
  failed.catch(() => undefined);
  return { worker, failed };
}
