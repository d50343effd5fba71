// A whole library as one text with a version, and back, all or nothing; and tags as a person writes them. Reading trusts nothing
// and names the document it stumbles over. Knows no place where documents are stored.

import * as v from 'valibot';
import { flawOfGroup, groupSchema, type ActionGroup } from '../group/group.ts';
import {
  readVersioned,
  versionedSchema,
  versionedText,
  type Read,
  type TextFlaw,
  count,
} from '../document/schema.ts';

// Tags as a person writes them, and back.

const MAX_TAGS = 20;
const MAX_TAG_LENGTH = 64;

export const tagsToText = (tags: readonly string[]): string => tags.join(', ');

/** Each once, in the order written; the commas of Chinese text count too. */
export function tagsFromText(text: string): readonly string[] {
  const written = text
    .split(/[,，、]/u)
    .map((tag) => tag.trim().slice(0, MAX_TAG_LENGTH))
    .filter((tag) => tag !== '');
  return [...new Set(written)].slice(0, MAX_TAGS);
}

const FORMAT = 'servodeck-library';

const versionSchema = v.strictObject({
  name: v.pipe(v.string(), v.maxLength(64)),
  atMs: count,
  group: groupSchema,
});
const documentSchema = v.strictObject({
  id: v.pipe(v.string(), v.regex(/^[A-Za-z0-9-]{1,64}$/)),
  updatedAtMs: count,
  group: groupSchema,
  versions: v.pipe(v.array(versionSchema), v.maxLength(200)),
});

const libraryFileSchema = versionedSchema(
  FORMAT,
  v.strictObject({ documents: v.pipe(v.array(documentSchema), v.maxLength(5000)) }),
);

export interface BundledVersion {
  readonly name: string;
  readonly atMs: number;
  readonly group: ActionGroup;
}

export interface BundledDocument {
  readonly id: string;
  readonly updatedAtMs: number;
  readonly group: ActionGroup;
  readonly versions: readonly BundledVersion[];
}

interface Bundle {
  readonly documents: readonly BundledDocument[];
}

export const libraryToText = (bundle: Bundle): string => versionedText(FORMAT, bundle);

export const libraryFromText = (text: string): Read<Bundle> =>
  readVersioned<Bundle>(text, libraryFileSchema, flawOfBundle);

function flawOfBundle({ documents }: Bundle): TextFlaw | null {
  if (new Set(documents.map(({ id }) => id)).size < documents.length) return { code: 'sameNumber', at: '' };
  for (const { group, versions } of documents) {
    for (const one of [group, ...versions.map((version) => version.group)]) {
      const flaw = flawOfGroup(one);
      if (flaw !== null) return { ...flaw, at: [group.name, flaw.at].join(' ').trim() };
    }
  }
  return null;
}
