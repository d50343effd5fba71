// A document store in memory, for the gallery and for tests. Follows the same contract as the others.

import {
  nextRevision,
  required,
  type Facts,
  type DocumentStore,
  type Listed,
  type Version,
  type Writing,
} from '#shared/files/documentStore.ts';

interface Entry extends Writing {
  readonly revision: number;
}

export function createMemoryStore(place: DocumentStore['place'] = 'browser'): DocumentStore {
  const documents = new Map<string, Entry>();
  const versions = new Map<string, Map<string, { version: Version; text: string }>>();

  const listed = ([id, { revision, isRemoved, facts }]: [string, Entry]): Listed<Facts> => ({
    ...{ id, revision, isRemoved, facts },
  });

  function mark(ids: readonly string[], isRemoved: boolean): void {
    const marked = ids.map((id) => [id, { ...required(documents.get(id)), isRemoved }] as const);
    for (const [id, document] of marked) documents.set(id, document);
  }

  const versionsOf = (id: string) =>
    versions.get(id) ?? new Map<string, { version: Version; text: string }>();

  return {
    place,
    list: () =>
      requested(() => ({ documents: [...documents].map(listed), damagedFile: null, changesLost: false })),
    read: (id) =>
      requested(() => {
        const { text, revision } = required(documents.get(id));
        return { text, revision };
      }),
    write: (id, writing) =>
      requested(() => {
        const revision = nextRevision(documents.get(id), writing);
        documents.set(id, { ...writing, revision });
        return revision;
      }),
    remove: (ids) => requested(() => mark(ids, true)),
    restore: (ids) => requested(() => mark(ids, false)),
    versions: (id) =>
      requested(() =>
        [...versionsOf(id).values()]
          .map(({ version }) => version)
          .sort((one, other) => one.atMs - other.atMs),
      ),
    readVersion: (id, version) => requested(() => required(versionsOf(id).get(version)).text),
    keepVersion: (id, version, text) =>
      requested(() => {
        required(documents.get(id));
        versions.set(id, versionsOf(id).set(version.id, { version, text }));
      }),
    removeVersion: (id, version) =>
      requested(() => {
        required(versionsOf(id).get(version));
        versionsOf(id).delete(version);
      }),
  };
}

/** Errors become rejections, as in the other stores. */
const requested = <T>(work: () => T): Promise<T> => new Promise((resolve) => resolve(work()));
