// A mapping as text with a version, and back; for storage. Reading trusts nothing. Knows no place to store anything.

import * as v from 'valibot';
import { mappingSchema, type Mapping } from './mapping.ts';
import { readVersioned, versionedText, type Read } from '../document/versionedText.ts';

const FORMAT = 'servodeck-mapping';

const fileSchema = v.strictObject({
  format: v.literal(FORMAT),
  version: v.literal(1),
  content: mappingSchema,
});

export const mappingToText = (mapping: Mapping): string => versionedText(FORMAT, mapping);

export function mappingFromText(text: string): Read<Mapping> {
  return readVersioned(text, fileSchema, () => null);
}
