// The document store in the gateway's data folder, over HTTP. Validates every answer; every failure is a LibraryError.

import * as v from 'valibot';
import { factsSchema } from '#shared/files/factsSchema.ts';
import { LibraryError, type DocumentStore, type LibraryErrorCode } from '#shared/files/documentStore.ts';
import { GatewayProblem, request, type Method } from '../../robot/request.ts';
import type {
  DocumentIds,
  DocumentWrite,
  DocumentWritten,
  LibraryListing,
  ListedVersion,
  StoredDocument,
  VersionText,
  VersionWrite,
} from './library.generated.ts';

const ANSWER_WITHIN_MS = 10_000;
/** The gateway's limit. */
const MAX_TEXT_LENGTH = 2 * 1024 * 1024;

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
const nothing = v.unknown();

export const gatewayStore: DocumentStore = {
  place: 'gateway',
  list: () => ask('', 'GET', listingSchema),
  read: (id) => ask(`/${id}`, 'GET', storedSchema),
  async write(id, { text, facts, expected, isRemoved }) {
    if (text.length > MAX_TEXT_LENGTH) throw new LibraryError('tooLarge', 'the text is too long');
    const wanted: DocumentWrite = { text, facts, expected, isRemoved };
    const { revision } = await ask(`/${id}`, 'PUT', writtenSchema, wanted);
    return revision;
  },
  remove: (ids) => mark('remove', ids),
  restore: (ids) => mark('restore', ids),
  versions: (id) => ask(`/${id}/versions`, 'GET', versionsSchema),
  readVersion: async (id, version) =>
    (await ask(`/${id}/versions/${version}`, 'GET', versionTextSchema)).text,
  async keepVersion(id, { id: version, name, atMs }, text) {
    const wanted: VersionWrite = { name, atMs, text };
    await ask(`/${id}/versions/${version}`, 'PUT', nothing, wanted);
  },
  async removeVersion(id, version) {
    await ask(`/${id}/versions/${version}`, 'DELETE', nothing);
  },
};

async function mark(verb: 'remove' | 'restore', ids: readonly string[]): Promise<void> {
  const wanted: DocumentIds = { ids: [...ids] };
  await ask(`/${verb}`, 'POST', nothing, wanted);
}

async function ask<T>(
  path: string,
  method: Method,
  schema: v.GenericSchema<unknown, T>,
  body?: object,
): Promise<T> {
  const asking = { method, body, withinMs: ANSWER_WITHIN_MS };
  const answer = await request(`api/library${path}`, asking).catch((error: unknown) => {
    throw problem(error);
  });
  const read = v.safeParse(schema, answer);
  if (!read.success) throw new LibraryError('failed', 'the gateway’s answer is none');
  return read.output;
}

function problem(error: unknown): unknown {
  if (!(error instanceof GatewayProblem)) return error;
  const code = error.code === null ? 'unreachable' : (CODES[error.code] ?? 'failed');
  return new LibraryError(code, error.message, { cause: error });
}
