// A book of poses as text with a version, and back; the same for storage and files. Reading trusts nothing and says what is
// wrong. Knows no place to store anything and no robot's limits.

import * as v from 'valibot';
import { flawOfBook, poseBookSchema, type PoseBook } from './pose.ts';
import { readVersioned, versionedText, type Read } from '../document/versionedText.ts';

const FORMAT = 'servodeck-poses';

const fileSchema = v.strictObject({
  format: v.literal(FORMAT),
  version: v.literal(1),
  content: poseBookSchema,
});

export const poseBookToText = (book: PoseBook): string => versionedText(FORMAT, book);

export function poseBookFromText(text: string): Read<PoseBook> {
  return readVersioned(text, fileSchema, flawOfBook);
}
