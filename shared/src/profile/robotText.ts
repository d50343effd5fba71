// A robot as a file, and back: JSON that carries its version and follows the published schema, docs/robot.schema.json. Reading
// trusts nothing and says what is wrong. Knows no place to store anything.

import * as v from 'valibot';
import { flawOf, robotSchema, roughRobotSchema, type Robot, type RobotFlaw } from './robot.ts';
import { placeOf } from '../document/schemas.ts';
import { shapeFlaw } from './robotShape.ts';

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

export type ReadRobot = { readonly robot: Robot } | { readonly problem: RobotFileFlaw };

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
