// The document store in the gateway's data folder, over HTTP. Validates every answer; every failure is a LibraryError.

import * as v from 'valibot';
import { factsSchema } from '#shared/files/facts.ts';
import { LibraryError, type DocumentStore, type LibraryErrorCode } from '#shared/files/documentStore.ts';
import { requestsOf } from '../../robot/request.ts';
import type {
  DocumentWritten,
  LibraryListing,
  ListedVersion,
  StoredDocument,
  VersionText,
} from '#shared/client/http.generated.ts';

const ANSWER_WITHIN_MS = 10_000;
/** The gateway's limit. */
const MAX_TEXT_LENGTH = 2 * 1024 * 1024;

const VERSION = '/api/library/{document}/versions/{version}';

const CODES: Readonly<Record<string, LibraryErrorCode>> = {
  conflict: 'conflict',
  notFound: 'notFound',
  storageFull: 'full',
  storageBusy: 'busy',
  tooLarge: 'tooLarge',
  damaged: 'damaged',
};

const whole = v.pipe(v.number(), v.safeInteger());
const listingSchema: v.GenericSchema<unknown, LibraryListing> = v.object({
  documents: v.array(
    v.object({ id: v.string(), revision: whole, isRemoved: v.boolean(), facts: factsSchema }),
  ),
  damagedFile: v.nullable(v.string()),
  changesLost: v.boolean(),
});
const storedSchema: v.GenericSchema<unknown, StoredDocument> = v.object({
  text: v.string(),
  revision: whole,
});
const writtenSchema: v.GenericSchema<unknown, DocumentWritten> = v.object({ revision: whole });
const versionsSchema: v.GenericSchema<unknown, ListedVersion[]> = v.array(
  v.object({ id: v.string(), name: v.string(), atMs: whole }),
);
const versionTextSchema: v.GenericSchema<unknown, VersionText> = v.object({ text: v.string() });

const { ask, send } = requestsOf({
  withinMs: ANSWER_WITHIN_MS,
  failed: ({ code, message }, options) =>
    new LibraryError(code === null ? 'unreachable' : (CODES[code] ?? 'failed'), message, options),
  unreadable: () => new LibraryError('failed', 'the gateway’s answer is none'),
});

export const gatewayStore: DocumentStore = {
  place: 'gateway',
  list: () => ask('get', '/api/library', listingSchema, {}),
  read: (id) => ask('get', '/api/library/{document}', storedSchema, { values: { document: id } }),
  async write(id, { text, facts, expected, isRemoved }) {
    if (text.length > MAX_TEXT_LENGTH) throw new LibraryError('tooLarge', 'the text is too long');
    const body = { text, facts, expected, isRemoved };
    const requested = { values: { document: id }, body };
    const { revision } = await ask('put', '/api/library/{document}', writtenSchema, requested);
    return revision;
  },
  remove: (ids) => send('post', '/api/library/remove', { body: { ids } }),
  restore: (ids) => send('post', '/api/library/restore', { body: { ids } }),
  versions: (id) =>
    ask('get', '/api/library/{document}/versions', versionsSchema, { values: { document: id } }),
  readVersion: async (id, version) =>
    (await ask('get', VERSION, versionTextSchema, { values: { document: id, version } })).text,
  async keepVersion(id, { id: version, name, atMs }, text) {
    await send('put', VERSION, { values: { document: id, version }, body: { name, atMs, text } });
  },
  async removeVersion(id, version) {
    await send('delete', VERSION, { values: { document: id, version } });
  },
};
