// A mapping as text with a version, and back; for storage. Reading trusts nothing. Knows no place to store anything.

import * as z from 'zod/mini';
import { mappingSchema, type Mapping } from './mapping.ts';
import { readVersioned, versionedText, type Read } from '../versionedText.ts';

const FORMAT = 'servodeck-mapping';

const fileSchema = z.strictObject({
  format: z.literal(FORMAT),
  version: z.literal(1),
  content: mappingSchema,
});

export const mappingToText = (mapping: Mapping): string => versionedText(FORMAT, mapping);

export function mappingFromText(text: string): Read<Mapping> {
  return readVersioned(text, fileSchema, () => null);
}
