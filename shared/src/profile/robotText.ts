// A robot as a file, and back: JSON that carries its version and follows the published schema, docs/robot.schema.json; and a robot
// with all that belongs to it as one text of the library. Reading trusts nothing and says what is wrong. Knows no place to store
// anything.

import * as v from 'valibot';
import { flawOf, robotSchema, roughRobotSchema, type Robot, type RobotFlaw, shapeFlaw } from './robot.ts';
import { placeOf, readJson } from '../document/schema.ts';

const FORMAT = 'servodeck-robot';
const VERSION = 1;

/** Other programs may use it. */
export const robotFileSchema = v.strictObject({
  format: v.literal(FORMAT),
  version: v.literal(VERSION),
  robot: robotSchema,
});

const roughSchema = v.strictObject({ ...robotFileSchema.entries, robot: roughRobotSchema });

export function robotToText(robot: Robot): string {
  return `${JSON.stringify({ format: FORMAT, version: VERSION, robot }, null, 2)}\n`;
}

/** `notOurs`: it is no robot file of ours. `otherVersion`: of another version of ours. */
export type RobotFileFlaw = RobotFlaw | { readonly code: 'notOurs' | 'otherVersion' };

type ReadRobot = { readonly robot: Robot } | { readonly problem: RobotFileFlaw };

export function robotFromText(text: string): ReadRobot {
  const found = jsonIn(text);
  const parsed = v.safeParse(robotFileSchema, found);
  if (!parsed.success) return { problem: reachFlaw(found) ?? problemOf(parsed.issues[0], found) };
  const { robot } = parsed.output;
  const flaw = flawOf(robot);
  return flaw === null ? { robot } : { problem: flaw };
}

function jsonIn(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return undefined;
  }
}

/** A number out of range, with its servo's name and what it may be. */
function reachFlaw(found: unknown): RobotFlaw | null {
  const read = v.safeParse(roughSchema, found);
  return read.success ? flawOf(read.output.robot) : null;
}

const anyRobot = v.object({ robot: v.unknown() });

function problemOf(issue: v.BaseIssue<unknown>, found: unknown): RobotFileFlaw {
  const file = v.safeParse(anyRobot, found);
  const [part = 'format'] = placeOf(issue);
  if (part === 'format' || !file.success) return { code: 'notOurs' };
  return part === 'version' ? { code: 'otherVersion' } : shapeFlaw(issue, file.output.robot);
}

// A robot with all that belongs to it, as one text of the library: what it is made of is texts of their own. Two that
// were changed at the same time go together where they were changed in different parts.

const KIT_FORMAT = 'servodeck-robot-kit';
const part = v.nullable(v.string());

const kitSchema = v.strictObject({ robot: v.string(), poses: part, buttons: part, pad: part });
const fileSchema = v.strictObject({ format: v.literal(KIT_FORMAT), version: v.literal(1), kit: kitSchema });

/** null: as it comes with every robot. */
export type Kit = Readonly<v.InferOutput<typeof kitSchema>>;

export const KIT_PARTS = ['robot', 'poses', 'buttons', 'pad'] as const satisfies readonly (keyof Kit)[];

export function kitToText(kit: Kit): string {
  return JSON.stringify({ format: KIT_FORMAT, version: 1, kit });
}

/** null where a newer version has written it, or where it is no robot. */
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
