// A mapping as text with a version, for storage, and back. Reading trusts nothing. Knows no place to store anything.

import * as z from 'zod/mini';
import { mappingSchema, type Mapping } from './mapping.ts';

const FORMAT = 'servodeck-mapping';
const VERSION = 1;

const fileSchema = z.strictObject({
  format: z.literal(FORMAT),
  version: z.literal(VERSION),
  mapping: mappingSchema,
});

export function mappingToText(mapping: Mapping): string {
  return `${JSON.stringify({ format: FORMAT, version: VERSION, mapping })}\n`;
}

/** null where the text is no mapping of this version. */
export function mappingFromText(text: string): Mapping | null {
  try {
    return fileSchema.parse(JSON.parse(text)).mapping;
  } catch {
    return null;
  }
}
