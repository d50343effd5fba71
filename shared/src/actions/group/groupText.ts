// An action group as text with a version, and back; the same for storage and files. Reading trusts nothing and says what is
// wrong. Knows no place to store anything and no board's limits.

import * as z from 'zod/mini';
import { readVersioned, versionedLine, versionedText, type Read } from '../versionedText.ts';
import { flawOfGroup, groupSchema, type ActionGroup } from './group.ts';

const FORMAT = 'servodeck-group';

export const groupFileSchema = z.strictObject({
  format: z.literal(FORMAT),
  version: z.literal(1),
  content: groupSchema,
});

/** The schema that other programs may use: docs/group.schema.json. */
export function publishedGroupSchema(): object {
  return z.toJSONSchema(groupFileSchema, { target: 'draft-2020-12' });
}

export const groupToText = (group: ActionGroup): string => versionedLine(FORMAT, group);

/** The same, for people to read. */
export const groupToFile = (group: ActionGroup): string => versionedText(FORMAT, group);

/** By what they say, whoever made the objects. */
export const sameGroup = (one: ActionGroup, other: ActionGroup): boolean => plain(one) === plain(other);

const plain = (group: ActionGroup): string => JSON.stringify(groupSchema.safeParse(group).data);

export function groupFromText(text: string): Read<ActionGroup> {
  return readVersioned(text, groupFileSchema, flawOfGroup);
}
