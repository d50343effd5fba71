// The document store in the browser (IndexedDB), for pages without a gateway. Texts are stored apart from the listed facts, so that a
// list reads no text. Every failure is a LibraryError.

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

/** The kind of rows from before robots were stored, which have none. */
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
      // Another tab may upgrade the database, or the browser may clear it: then it is opened again.
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

/** Runs a transaction; resolves when it is on the disk. `work` must await nothing but requests of the transaction. */
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
    completed.catch(() => undefined); // `error` has more details
    if (transaction.error === null) tryToAbort(transaction);
    throw error;
  }
}

function tryToAbort(transaction: IDBTransaction): void {
  try {
    transaction.abort();
  } catch {
    // The transaction has already ended.
  }
}

/** The part of an IDBRequest in use, with `unknown` in place of the library's `any`. */
interface PendingRequest {
  readonly result: unknown;
  readonly error: DOMException | null;
  addEventListener(event: 'success' | 'error', listener: () => void): void;
}

/** Trusts that a result has the type that this module stored. */
function done<T>(requested: PendingRequest): Promise<T> {
  return new Promise((resolve, reject) => {
    requested.addEventListener('success', () => resolve(requested.result as T));
    requested.addEventListener('error', () =>
      reject(requested.error ?? new Error('the browser’s database refused')),
    );
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
