// Pieces of schemas that several documents share.

import * as v from 'valibot';

/** A whole number, both ends included. */
export const whole = (min: number, max: number) =>
  v.pipe(v.number(), v.integer(), v.minValue(min), v.maxValue(max));

/** A number of something, a revision, or milliseconds since 1970. */
export const count = whole(0, Number.MAX_SAFE_INTEGER);

/** Of a part of a document: never used twice in it, so an undone part comes back as itself. */
export const runningId = whole(1, Number.MAX_SAFE_INTEGER);

/** Where something is wrong; of a field too many, where it stands. */
export function placeOf({ path, expected }: v.BaseIssue<unknown>): readonly unknown[] {
  const keys = path?.map(({ key }) => key) ?? [];
  return expected === 'never' ? keys.slice(0, -1) : keys;
}

export const targetSchema = v.strictObject({ servo: whole(0, 0xff), position: whole(0, 0xffff) });
