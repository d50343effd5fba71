// A robot as a file, and back: JSON that carries its version and follows the published schema, docs/robot.schema.json. Reading
// trusts nothing and says what is wrong. Knows no place to store anything.

import * as z from 'zod/mini';
import { flawOf, robotSchema, roughRobotSchema, type Robot, type RobotFlaw } from './robot.ts';
import { shapeFlaw } from './robotShape.ts';

const FORMAT = 'servodeck-robot';
const VERSION = 1;

const fileSchema = z.strictObject({
  format: z.literal(FORMAT),
  version: z.literal(VERSION),
  robot: robotSchema,
});

const roughSchema = z.extend(fileSchema, { robot: roughRobotSchema });

export function robotToText(robot: Robot): string {
  return `${JSON.stringify({ format: FORMAT, version: VERSION, robot }, null, 2)}\n`;
}

/** `notOurs`: it is no robot file of ours. `otherVersion`: of another version of ours. */
export type RobotFileFlaw = RobotFlaw | { readonly code: 'notOurs' | 'otherVersion' };

export type ReadRobot = { readonly robot: Robot } | { readonly problem: RobotFileFlaw };

export function robotFromText(text: string): ReadRobot {
  const found = jsonIn(text);
  const parsed = fileSchema.safeParse(found);
  if (!parsed.success) return { problem: reachFlaw(found) ?? problemOf(parsed.error, found) };
  const { robot } = parsed.data;
  const flaw = flawOf(robot);
  return flaw === null ? { robot } : { problem: flaw };
}

/** The schema that other programs may use. */
export function publishedSchema(): object {
  return z.toJSONSchema(fileSchema, { target: 'draft-2020-12' });
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
  const { data } = roughSchema.safeParse(found);
  return data === undefined ? null : flawOf(data.robot);
}

const anyRobot = z.object({ robot: z.unknown() });

function problemOf(error: z.core.$ZodError, found: unknown): RobotFileFlaw {
  const { data: file } = anyRobot.safeParse(found);
  const [part = 'format'] = error.issues[0]?.path ?? [];
  if (part === 'format' || file === undefined) return { code: 'notOurs' };
  return part === 'version' ? { code: 'otherVersion' } : shapeFlaw(error, file.robot);
}
