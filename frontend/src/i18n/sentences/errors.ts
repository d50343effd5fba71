// What went wrong, in a sentence: links, values out of range, the library, documents. No panel writes its own.

import type { LibraryErrorCode } from '#shared/files/keeper.ts';
import type { TextFlaw } from '#shared/document/schema.ts';
import type { RangeRefusal } from '#shared/codec/limits.ts';
import type { LinkErrorCode } from '#shared/robot/linkError.ts';
import { words } from '../words.ts';
import { say } from './say.ts';

/** `detail` is left out where the sentence is complete without it. */
export function errorSentence(code: LinkErrorCode, detail = ''): string {
  const detailed = words.errorsWithDetail;
  return code in detailed && isForReader(code, detail)
    ? detailed[code as keyof typeof detailed]({ detail: detail.replace(/[.。]$/u, '') })
    : words.errors[code];
}

/** Programs write details in English. In another language they are for whoever mends Servodeck alone. */
function isForReader(code: LinkErrorCode, detail: string): boolean {
  if (detail === '') return false;
  return words.locale === 'en' || code === 'internal' || /\P{ASCII}/u.test(detail);
}

/** Which value a board cannot take, and what is allowed; no sentence yet. */
export function rangeText({ field, value, min, max, allowed = '', servo }: RangeRefusal): string {
  const { fields, ofServo, servoTwice, range, notTaken } = words.refusals;
  const name = servo === undefined ? fields[field] : ofServo({ field: fields[field], servo });
  if (min !== undefined && max !== undefined) return range({ field: name, value: String(value), min, max });
  if (field === 'servo') return servoTwice({ value: String(value) });
  return notTaken({ field: name, value: String(value), allowed });
}

/** What is wrong with a document that was stored or written to a file. */
export function flawSentence({ code, at }: TextFlaw): string {
  if (code === 'sameNumber' && at === '') return words.flaws.sameNumberInFile;
  return say(words.flaws[code], { found: at });
}

export function libraryProblem(code: LibraryErrorCode, detail: string): string {
  return say(words.library.problems[code], { detail });
}
