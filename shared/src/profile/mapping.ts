// What the inputs of a pad and of a keyboard do to a robot: a list of bindings and how the sticks feel. One immutable value with
// one schema, and what two bindings have against each other. Knows no pad, no time and no session.

import * as v from 'valibot';
import { POSE_MS, poseRefSchema } from './pose.ts';
import { whole } from '../document/schemas.ts';

/** Which part of an axis counts: all of it with its sign, or one side as if it were a button. */
export const SIDES = ['whole', 'minus', 'plus'] as const;

const index = whole(0, 63);
const servo = whole(1, 253);

const inputSchema = v.variant('kind', [
  v.strictObject({ kind: v.literal('axis'), index, side: v.picklist(SIDES) }),
  v.strictObject({ kind: v.literal('button'), index }),
  /** A key by its place on the keyboard, as browsers call it, e.g. `KeyQ`. */
  v.strictObject({ kind: v.literal('key'), code: v.pipe(v.string(), v.minLength(1), v.maxLength(32)) }),
]);

/** The fastest a servo may be asked to follow: any servo's whole range in less than a second. */
export const FASTEST_UNITS_PER_S = 3000;

const actionSchema = v.variant('kind', [
  /** Turns on while the input is away from rest; at full deflection by so much, negative the other way. */
  v.strictObject({
    kind: v.literal('rate'),
    servo,
    unitsPerS: whole(-FASTEST_UNITS_PER_S, FASTEST_UNITS_PER_S),
  }),
  /** The input's way is the servo's range. */
  v.strictObject({ kind: v.literal('position'), servo, isReversed: v.boolean() }),
  v.strictObject({
    kind: v.literal('pose'),
    pose: poseRefSchema,
    durationMs: whole(POSE_MS.min, POSE_MS.max),
  }),
  v.strictObject({ kind: v.literal('run'), slot: whole(0, 255) }),
  v.strictObject({ kind: v.literal('stop') }),
]);

const bindingSchema = v.pipe(
  v.strictObject({ input: inputSchema, action: actionSchema }),
  // Letting go of a key must never be what moves a servo.
  v.check(({ input, action }) => input.kind !== 'key' || action.kind !== 'position'),
);

const feelSchema = v.strictObject({
  /** So much of a stick's way counts as rest: worn sticks never come back to the very middle. */
  deadZonePercent: whole(0, 50),
  /** 0 is a straight line; the more, the finer near the middle. */
  curvePercent: whole(0, 100),
  /** How long a sudden change takes to get through for the most part. */
  smoothingMs: whole(0, 500),
  /** Share of each binding's own speed. */
  speedPercent: whole(10, 100),
});

export const mappingSchema = v.strictObject({
  bindings: v.pipe(v.array(bindingSchema), v.maxLength(256)),
  feel: feelSchema,
});

export type Input = Readonly<v.InferOutput<typeof inputSchema>>;
export type Action = Readonly<v.InferOutput<typeof actionSchema>>;
export type Feel = Readonly<v.InferOutput<typeof feelSchema>>;
export interface Binding {
  readonly input: Input;
  readonly action: Action;
}
export interface Mapping {
  readonly bindings: readonly Binding[];
  readonly feel: Feel;
}

/** The servo a binding turns; null where it does something else. */
export function servoBoundBy({ action }: Binding): number | null {
  return 'servo' in action ? action.servo : null;
}

/** Bindings are named by their place in the list. */
export type Conflict =
  | { readonly kind: 'sameInput'; readonly one: number; readonly other: number }
  /** A position and anything else on one servo: they pull it back and forth. Speeds just add up. */
  | { readonly kind: 'sharedServo'; readonly servo: number };

/** What the person should know; nothing of it is forbidden. */
export function conflicts({ bindings }: Mapping): readonly Conflict[] {
  const sameInputs = bindings.flatMap(({ input }, one) =>
    bindings.flatMap(({ input: second }, other): readonly Conflict[] =>
      other > one && overlaps(input, second) ? [{ kind: 'sameInput', one, other }] : [],
    ),
  );
  return [
    ...sameInputs,
    ...sharedServos(bindings).map((shared): Conflict => ({ kind: 'sharedServo', servo: shared })),
  ];
}

function sharedServos(bindings: readonly Binding[]): readonly number[] {
  const positioned = bindings.flatMap(({ action }) => (action.kind === 'position' ? [action.servo] : []));
  return [...new Set(positioned)].filter(
    (wanted) => bindings.filter((binding) => servoBoundBy(binding) === wanted).length > 1,
  );
}

/** Whether one movement of a finger is meant by both. */
export function overlaps(one: Input, other: Input): boolean {
  if (one.kind === 'key' || other.kind === 'key')
    return one.kind === 'key' && other.kind === 'key' && one.code === other.code;
  if (one.kind !== other.kind || one.index !== other.index) return false;
  if (one.kind === 'button' || other.kind === 'button') return true;
  return one.side === other.side || one.side === 'whole' || other.side === 'whole';
}
