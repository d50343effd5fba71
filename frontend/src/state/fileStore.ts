// Files of this computer in the browser's database, each under a hash of its bytes: models in 3D and sounds. The document that uses one names
// it by that hash. Knows no content.

import { fingerprintOfNumbers } from '#shared/group/fingerprint.ts';

const DATABASE = 'servodeck-files';
const FILES = 'files';

/** Returns its id. Rejects where the browser stores nothing, or no more. */
export async function storeFile(bytes: Uint8Array): Promise<string> {
  const id = fingerprintOfNumbers(bytes);
  await inDatabase('readwrite', (files) => files.put(bytes, id));
  return id;
}

/** null: chosen on another computer, or the browser has cleared its storage. */
export async function storedFile(id: string): Promise<Uint8Array | null> {
  const found = await inDatabase('readonly', (files) => files.get(id) as IDBRequest<unknown>);
  return found instanceof Uint8Array ? found : null;
}

async function inDatabase<T>(
  mode: IDBTransactionMode,
  work: (files: IDBObjectStore) => IDBRequest<T>,
): Promise<T> {
  const database = await opened();
  try {
    return await new Promise((resolve, reject) => {
      const transaction = database.transaction(FILES, mode);
      const request = work(transaction.objectStore(FILES));
      transaction.addEventListener('complete', () => resolve(request.result));
      transaction.addEventListener('abort', () => reject(transaction.error ?? new Error('aborted')));
    });
  } finally {
    database.close();
  }
}

function opened(): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(DATABASE, 1);
    request.addEventListener('upgradeneeded', () => request.result.createObjectStore(FILES));
    request.addEventListener('success', () => resolve(request.result));
    request.addEventListener('error', () =>
      reject(request.error ?? new Error('the browser’s database refused')),
    );
  });
}
