// Pieces of schemas that several documents share.

import * as z from 'zod/mini';

/** A whole number, both ends included. */
export const whole = (min: number, max: number) => z.number().check(z.int(), z.gte(min), z.lte(max));

/** A number of something, a revision, or milliseconds since 1970. */
export const count = whole(0, Number.MAX_SAFE_INTEGER);

/** Of a part of a document: never used twice in it, so an undone part comes back as itself. */
export const runningId = whole(1, Number.MAX_SAFE_INTEGER);

export const targetSchema = z.strictObject({ servo: whole(0, 0xff), position: whole(0, 0xffff) });
