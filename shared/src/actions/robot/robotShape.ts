// Where something has not the shape of a robot: which of its fields, and of which servo, for whoever has the words. Knows no schema.

import * as z from 'zod/mini';

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

/** Paths of the error begin at the robot, or at a file with a `robot` in it. */
export function shapeFlaw({ issues: [first] }: z.core.$ZodError, robot: unknown): ShapeFlaw {
  const path = first?.path ?? [];
  const of = servoOn(path, robot);
  if (first?.code === 'unrecognized_keys') return { code: 'strangeField', field: first.keys[0] ?? '', of };
  return { code: 'field', field: path.findLast(isField) ?? 'robot', of };
}

const isField = (step: PropertyKey): step is RobotField => ROBOT_FIELDS.some((field) => field === step);

const named = z.catch(z.object({ name: z.catch(z.string(), '') }), { name: '' });
const namedServos = z.object({ servos: z.array(named) });

function servoOn(path: readonly PropertyKey[], robot: unknown): ServoInList | null {
  const at = path[path.indexOf('servos') + 1];
  if (typeof at !== 'number') return null;
  const { data } = namedServos.safeParse(robot);
  return { place: at + 1, name: data?.servos[at]?.name ?? '' };
}
