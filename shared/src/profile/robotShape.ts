// Where something has not the shape of a robot: which of its fields, and of which servo, for whoever has the words. Knows no schema.

import * as v from 'valibot';
import { placeOf } from '../document/schemas.ts';

export const ROBOT_FIELDS = [
  ...(['robot', 'name', 'board', 'body', 'servos'] as const),
  ...(['battery', 'batteryCare', 'policy', 'thresholds', 'warnMv', 'alarmMv'] as const),
  ...(['servo', 'group', 'min', 'max', 'home', 'trim'] as const),
  ...(['isReversed', 'degreesPerUnit', 'mirror', 'place'] as const),
] as const;
export type RobotField = (typeof ROBOT_FIELDS)[number];

/** `field`: what stands there is none that can be. `strangeField`: no robot has such a one. `of`: null where it is of no servo. */
export type ShapeFlaw =
  | { readonly code: 'field'; readonly field: RobotField; readonly of: ServoInList | null }
  | { readonly code: 'strangeField'; readonly field: string; readonly of: ServoInList | null };

export interface ServoInList {
  /** From 1, in the order of the description. */
  readonly place: number;
  /** Empty where it has none. */
  readonly name: string;
}

/** The issue’s path begins at the robot, or at a file with a `robot` in it. */
export function shapeFlaw(issue: v.BaseIssue<unknown>, robot: unknown): ShapeFlaw {
  const path = placeOf(issue);
  const of = servoOn(path, robot);
  if (issue.expected === 'never') return { code: 'strangeField', field: String(issue.path?.at(-1)?.key), of };
  return { code: 'field', field: path.findLast(isField) ?? 'robot', of };
}

const isField = (step: unknown): step is RobotField => ROBOT_FIELDS.some((field) => field === step);

const named = v.fallback(v.object({ name: v.fallback(v.string(), '') }), { name: '' });
const namedServos = v.object({ servos: v.array(named) });

function servoOn(path: readonly unknown[], robot: unknown): ServoInList | null {
  const at = path[path.indexOf('servos') + 1];
  if (typeof at !== 'number') return null;
  const read = v.safeParse(namedServos, robot);
  const servos = read.success ? read.output.servos : [];
  return { place: at + 1, name: servos[at]?.name ?? '' };
}
