// A page of buttons as text with a version, and back; for storage. Reading trusts nothing. Knows no place to store anything.

import * as v from 'valibot';
import { flawOfPage, macroPageSchema, type MacroPage } from './macro.ts';
import { readVersioned, versionedText, type Read } from '../document/versionedText.ts';

const FORMAT = 'servodeck-buttons';

const fileSchema = v.strictObject({
  format: v.literal(FORMAT),
  version: v.literal(1),
  content: macroPageSchema,
});

export const macroPageToText = (page: MacroPage): string => versionedText(FORMAT, page);

export function macroPageFromText(text: string): Read<MacroPage> {
  return readVersioned(text, fileSchema, flawOfPage);
}
