// The library in this browser's own database (IndexedDB), where no gateway is. Texts lie beside what is listed of them, so
// that a list reads none. Every failure is a LibraryError.

import {
  LibraryError,
  nextRevision,
  required,
  TRASH_MS,
  type Facts,
  type DocumentStore,
  type Stored,
  type Version,
} from '#shared/files/documentStore.ts';

/** Rows of before robots were kept say no kind. */
const OLDEST = { kind: 'group' } as const;
const STORES = ['documents', 'texts', 'versions'] as const;

interface Row {
  readonly id: string;
  readonly revision: number;
  readonly removedAtMs: number | null;
  readonly facts: Facts;
}

interface VersionRow extends Version {
  readonly document: string;
  readonly text: string;
}

type StoreOf = (name: (typeof STORES)[number]) => IDBObjectStore;

export function createBrowserStore(name: string, nowMs: () => number): DocumentStore {
  let opened: Promise<IDBDatabase> | null = null;

  function open(): Promise<IDBDatabase> {
    opened ??= openDatabase(name).then(async (database) => {
      // Another tab may want to change the shape, or the browser may clear everything: then it is opened anew.
      database.onversionchange = () => {
        database.close();
        opened = null;
      };
      database.onclose = () => (opened = null);
      await transact(database, 'readwrite', (store) => emptyTrash(store, nowMs() - TRASH_MS));
      return database;
    });
    return opened;
  }

  async function inside<T>(mode: IDBTransactionMode, work: (store: StoreOf) => Promise<T>): Promise<T> {
    try {
      return await transact(await open(), mode, work);
    } catch (error) {
      if (error instanceof LibraryError) throw error;
      opened = null;
      throw new LibraryError(codeOf(error), String(error), { cause: error });
    }
  }

  const mark = (ids: readonly string[], removedAtMs: number | null): Promise<void> =>
    inside('readwrite', async (store) => {
      for (const id of ids) {
        const row = required(await rowOf(store, id));
        await done(store('documents').put({ ...row, removedAtMs }));
      }
    });

  return {
    place: 'browser',
    list: () =>
      inside('readonly', async (store) => {
        const rows = await done<Row[]>(store('documents').getAll());
        const documents = rows.map(({ id, revision, removedAtMs, facts }) => ({
          ...{ id, revision, facts: { ...OLDEST, ...facts } },
          isRemoved: removedAtMs !== null,
        }));
        return { documents, damagedFile: null, changesLost: false };
      }),
    read: (id) => inside('readonly', async (store) => required(await storedOf(store, id))),
    write: (id, writing) =>
      inside('readwrite', async (store) => {
        const revision = nextRevision(await storedOf(store, id), writing);
        const removedAtMs = writing.isRemoved ? nowMs() : null;
        const row: Row = { id, revision, removedAtMs, facts: writing.facts };
        await done(store('documents').put(row));
        await done(store('texts').put(writing.text, id));
        return revision;
      }),
    remove: (ids) => mark(ids, nowMs()),
    restore: (ids) => mark(ids, null),
    versions: (id) =>
      inside('readonly', async (store) => {
        const rows = await done<VersionRow[]>(store('versions').getAll(ofDocument(id)));
        return rows
          .map((row) => ({ id: row.id, name: row.name, atMs: row.atMs }))
          .sort((one, other) => one.atMs - other.atMs);
      }),
    readVersion: (id, version) =>
      inside('readonly', async (store) => {
        const row = await done<VersionRow | undefined>(store('versions').get([id, version]));
        return required(row).text;
      }),
    keepVersion: (id, version, text) =>
      inside('readwrite', async (store) => {
        required(await rowOf(store, id));
        await done(store('versions').put({ ...version, document: id, text } satisfies VersionRow));
      }),
    removeVersion: (id, version) =>
      inside('readwrite', async (store) => {
        required(await done<VersionRow | undefined>(store('versions').get([id, version])));
        await done(store('versions').delete([id, version]));
      }),
  };
}

function openDatabase(name: string): Promise<IDBDatabase> {
  const request = indexedDB.open(name, 1);
  request.onupgradeneeded = () => {
    request.result.createObjectStore('documents', { keyPath: 'id' });
    request.result.createObjectStore('texts');
    request.result.createObjectStore('versions', { keyPath: ['document', 'id'] });
  };
  return done(request);
}

/** Whole or not at all; resolves when it is on the disk. `work` may wait for nothing but requests of its own. */
async function transact<T>(
  database: IDBDatabase,
  mode: IDBTransactionMode,
  work: (store: StoreOf) => Promise<T>,
): Promise<T> {
  const transaction = database.transaction(STORES, mode, { durability: 'strict' });
  const completed = new Promise<void>((resolve, reject) => {
    transaction.oncomplete = () => resolve();
    transaction.onabort = () => reject(transaction.error ?? new Error('aborted'));
  });
  try {
    const result = await work((name) => transaction.objectStore(name));
    await completed;
    return result;
  } catch (error) {
    completed.catch(() => undefined); // the error above says more
    if (transaction.error === null) tryToAbort(transaction);
    throw error;
  }
}

function tryToAbort(transaction: IDBTransaction): void {
  try {
    transaction.abort();
  } catch {
    // It has ended already.
  }
}

/** As much of an IDBRequest as is needed here: its own type lets anything through as `any`. */
interface Asked {
  readonly result: unknown;
  readonly error: DOMException | null;
  addEventListener(event: 'success' | 'error', listener: () => void): void;
}

/** What this module put in is what comes out. */
function done<T>(asked: Asked): Promise<T> {
  return new Promise((resolve, reject) => {
    asked.addEventListener('success', () => resolve(asked.result as T));
    asked.addEventListener('error', () => reject(asked.error ?? new Error('the browser’s database refused')));
  });
}

const rowOf = (store: StoreOf, id: string): Promise<Row | undefined> =>
  done<Row | undefined>(store('documents').get(id));

async function storedOf(store: StoreOf, id: string): Promise<Stored | undefined> {
  const row = await rowOf(store, id);
  const text = await done<string | undefined>(store('texts').get(id));
  return row === undefined || text === undefined ? undefined : { text, revision: row.revision };
}

const ofDocument = (id: string): IDBKeyRange => IDBKeyRange.bound([id], [id, []]);

async function emptyTrash(store: StoreOf, beforeMs: number): Promise<void> {
  const rows = await done<Row[]>(store('documents').getAll());
  for (const { id, removedAtMs } of rows) {
    if (removedAtMs === null || removedAtMs >= beforeMs) continue;
    await done(store('documents').delete(id));
    await done(store('texts').delete(id));
    await done(store('versions').delete(ofDocument(id)));
  }
}

const codeOf = (error: unknown): 'full' | 'failed' =>
  error instanceof DOMException && error.name === 'QuotaExceededError' ? 'full' : 'failed';
