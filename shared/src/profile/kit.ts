// A robot with all that belongs to it, as one text of the library: what it is made of is texts of their own. Two that were
// changed at the same time go together where they were changed in different parts. Knows nothing of what a part says.

import * as v from 'valibot';
import { readJson } from '../document/versionedText.ts';

const FORMAT = 'servodeck-robot-kit';
const part = v.nullable(v.string());

const kitSchema = v.strictObject({ robot: v.string(), poses: part, buttons: part, pad: part });
const fileSchema = v.strictObject({ format: v.literal(FORMAT), version: v.literal(1), kit: kitSchema });

/** null: as it comes with every robot. */
export type Kit = Readonly<v.InferOutput<typeof kitSchema>>;

export const KIT_PARTS = ['robot', 'poses', 'buttons', 'pad'] as const satisfies readonly (keyof Kit)[];

export function kitToText(kit: Kit): string {
  return JSON.stringify({ format: FORMAT, version: 1, kit });
}

/** null where a newer version has written it, or nobody. */
export function kitFromText(text: string): Kit | null {
  const read = readJson(text, fileSchema);
  return 'value' in read ? read.value.kit : null;
}

export function sameKit(one: Kit, other: Kit): boolean {
  return KIT_PARTS.every((name) => one[name] === other[name]);
}

/** What both come to, from what both began with; null where both have changed the same part. */
export function mergedKits(base: Kit, ours: Kit, theirs: Kit): Kit | null {
  const parts = KIT_PARTS.map((name) => [name, base[name], ours[name], theirs[name]] as const);
  if (parts.some(([, was, one, other]) => one !== was && other !== was && one !== other)) return null;
  return parts.reduce((kit, [name, was, one]) => (one === was ? kit : { ...kit, [name]: one }), theirs);
}
