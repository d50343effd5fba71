// An action group as text with a version, and back; the same for storage and files. Reading trusts nothing and says what is
// wrong. Knows no place to store anything and no board's limits.

import * as v from 'valibot';
import { readVersioned, versionedLine, versionedText, type Read } from '../document/versionedText.ts';
import { flawOfGroup, groupSchema, type ActionGroup } from './group.ts';

const FORMAT = 'servodeck-group';

/** Other programs may use it: docs/group.schema.json. */
export const groupFileSchema = v.strictObject({
  format: v.literal(FORMAT),
  version: v.literal(1),
  content: groupSchema,
});

export const groupToText = (group: ActionGroup): string => versionedLine(FORMAT, group);

/** The same, for people to read. */
export const groupToFile = (group: ActionGroup): string => versionedText(FORMAT, group);

/** By what they say, whoever made the objects. */
export const sameGroup = (one: ActionGroup, other: ActionGroup): boolean => plain(one) === plain(other);

const plain = (group: ActionGroup): string => JSON.stringify(v.safeParse(groupSchema, group).output);

export function groupFromText(text: string): Read<ActionGroup> {
  return readVersioned(text, groupFileSchema, flawOfGroup);
}
