// What a list says of a document, as it comes from elsewhere: one schema for each kind. Knows no place where documents are stored.

import * as v from 'valibot';
import { count, targetSchema, whole } from '../document/schema.ts';

const name = v.pipe(v.string(), v.maxLength(64));

const groupFactsSchema = v.strictObject({
  kind: v.literal('group'),
  name,
  robot: name,
  tags: v.pipe(v.array(name), v.maxLength(20)),
  /** Milliseconds since 1970. */
  updatedAtMs: count,
  frames: count,
  durationMs: count,
  unit: v.picklist(['us', 'steps']),
  /** Its picture. */
  pose: v.pipe(v.array(targetSchema), v.maxLength(256)),
});

/** What its keeper goes by itself: limits and poses are as the board counts. */
const robotFactsSchema = v.strictObject({
  kind: v.literal('robot'),
  name,
  board: name,
  updatedAtMs: count,
  limits: v.array(
    v.strictObject({ servo: whole(0, 0xff), name: v.string(), min: whole(0, 0xffff), max: whole(0, 0xffff) }),
  ),
  poses: v.array(
    v.strictObject({
      id: count,
      name: v.string(),
      unit: v.picklist(['us', 'steps']),
      targets: v.array(targetSchema),
    }),
  ),
});

export const factsSchema = v.variant('kind', [groupFactsSchema, robotFactsSchema]);

export type GroupFacts = v.InferOutput<typeof groupFactsSchema>;
export type RobotFacts = v.InferOutput<typeof robotFactsSchema>;
