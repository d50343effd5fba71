// The contract of document stores as cases that run under Node, and in a browser against IndexedDB and a gateway. Uses document ids of
// its own, so that a store may hold other documents.

import {
  LibraryError,
  type Facts,
  type DocumentStore,
  type Listed,
  type Writing,
} from '#shared/files/documentStore.ts';

const FACTS: Facts = {
  kind: 'group',
  ...{ name: 'Wave', robot: 'Arm', tags: ['greeting'], updatedAtMs: 1_790_000_000_000 },
  ...{ frames: 2, durationMs: 1500, unit: 'us', pose: [{ servo: 1, position: 1500 }] },
};

const writing = (x: number, expected: number, isRemoved = false): Writing => ({
  ...{ text: `{"x":${x}}`, facts: FACTS, expected, isRemoved },
});

type Case = (documentStore: DocumentStore, name: (short: string) => string) => Promise<void>;

export const STORE_CASES: Readonly<Record<string, Case>> = {
  'a document is kept, listed and read': async (documentStore, name) => {
    same(await documentStore.write(name('a'), writing(1, 0)), 1);
    same(await documentStore.write(name('a'), writing(2, 1)), 2);
    same(await documentStore.read(name('a')), { text: '{"x":2}', revision: 2 });
    const expected: Listed<Facts> = { id: name('a'), revision: 2, isRemoved: false, facts: FACTS };
    same(await listed(documentStore, name('a')), expected);
  },
  'a write at an old revision is refused and changes nothing': async (documentStore, name) => {
    await documentStore.write(name('a'), writing(1, 0));
    await documentStore.write(name('a'), writing(2, 1));
    same(await codeOf(documentStore.write(name('a'), writing(3, 1))), 'conflict');
    same(await codeOf(documentStore.write(name('a'), writing(3, 0))), 'conflict');
    same(await documentStore.read(name('a')), { text: '{"x":2}', revision: 2 });
  },
  'the same text sent again is no conflict': async (documentStore, name) => {
    await documentStore.write(name('a'), writing(1, 0));
    same(await documentStore.write(name('a'), writing(1, 0)), 1);
  },
  'a document of another place is taken in': async (documentStore, name) => {
    same(await documentStore.write(name('a'), writing(1, 7)), 8);
  },
  'removing and restoring is all or nothing, and a write restores': async (documentStore, name) => {
    await documentStore.write(name('a'), writing(1, 0));
    await documentStore.write(name('b'), writing(1, 0, true));
    same(await codeOf(documentStore.remove([name('a'), name('c')])), 'notFound');
    same(await codeOf(documentStore.restore([name('b'), name('c')])), 'notFound');
    same(await removed(documentStore, name('a'), name('b')), [false, true]);
    await documentStore.remove([name('a')]);
    same(await removed(documentStore, name('a'), name('b')), [true, true]);
    await documentStore.restore([name('a'), name('b')]);
    same(await removed(documentStore, name('a'), name('b')), [false, false]);
    await documentStore.remove([name('a')]);
    await documentStore.write(name('a'), writing(2, 1));
    same(await removed(documentStore, name('a')), [false]);
  },
  'versions stay as they were, oldest first': async (documentStore, name) => {
    const version = { id: name('v'), name: 'Later', atMs: 9 };
    same(await codeOf(documentStore.keepVersion(name('a'), version, '{}')), 'notFound');
    await documentStore.write(name('a'), writing(1, 0));
    const older = { id: name('u'), name: 'Older', atMs: 5 };
    await documentStore.keepVersion(name('a'), version, '{"x":1}');
    await documentStore.keepVersion(name('a'), older, '{"x":0}');
    await documentStore.write(name('a'), writing(2, 1));
    same(await documentStore.versions(name('a')), [older, version]);
    same(await documentStore.readVersion(name('a'), name('v')), '{"x":1}');
    same(await documentStore.versions(name('b')), []);
    same(await codeOf(documentStore.readVersion(name('a'), name('w'))), 'notFound');
  },
  'a version kept once more takes its new name and stays where it is': async (documentStore, name) => {
    await documentStore.write(name('a'), writing(1, 0));
    const first = { id: name('v5'), name: 'Kept', atMs: 5 };
    const second = { id: name('v9'), name: 'Kept', atMs: 9 };
    for (const version of [first, second]) await documentStore.keepVersion(name('a'), version, '{"x":1}');
    const renamed = { ...first, name: 'Renamed' };
    await documentStore.keepVersion(name('a'), renamed, '{"x":1}');
    same(await documentStore.versions(name('a')), [renamed, second]);
    same(await documentStore.readVersion(name('a'), name('v5')), '{"x":1}');
  },
  'a version goes alone': async (documentStore, name) => {
    await documentStore.write(name('a'), writing(1, 0));
    const versions = [5, 9].map((atMs) => ({ id: name(`v${atMs}`), name: 'Kept', atMs }));
    for (const version of versions) await documentStore.keepVersion(name('a'), version, '{"x":1}');
    await documentStore.removeVersion(name('a'), name('v5'));
    same(await documentStore.versions(name('a')), versions.slice(1));
    same(await codeOf(documentStore.removeVersion(name('a'), name('v5'))), 'notFound');
    same((await documentStore.read(name('a'))).text, '{"x":1}');
  },
  'what is not there is not found': async (documentStore, name) => {
    same(await codeOf(documentStore.read(name('a'))), 'notFound');
    same(await listed(documentStore, name('a')), undefined);
  },
};

async function listed(documentStore: DocumentStore, id: string): Promise<Listed<Facts> | undefined> {
  const { documents } = await documentStore.list();
  return documents.find((one) => one.id === id);
}

async function removed(documentStore: DocumentStore, ...ids: readonly string[]): Promise<unknown> {
  return Promise.all(ids.map(async (id) => (await listed(documentStore, id))?.isRemoved));
}

async function codeOf(refused: Promise<unknown>): Promise<string> {
  try {
    await refused;
    return 'not refused';
  } catch (error) {
    return error instanceof LibraryError ? error.code : String(error);
  }
}

function same(found: unknown, expected: unknown): void {
  const [one, other] = [found, expected].map((value) => JSON.stringify(ordered(value)));
  if (one !== other) throw new Error(`expected ${other}, found ${one}`);
}

/** Sorts the keys of each object. */
function ordered(value: unknown): unknown {
  if (Array.isArray(value)) return value.map(ordered);
  if (typeof value !== 'object' || value === null) return value;
  return Object.entries(value)
    .sort(([one], [other]) => one.localeCompare(other))
    .map(([key, each]) => [key, ordered(each)]);
}
