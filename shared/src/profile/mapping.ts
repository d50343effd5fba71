// What the inputs of a pad and of a keyboard do to a robot: a list of bindings and how the sticks feel. One immutable value with
// one schema, as text and back, and what two bindings have against each other. Knows no pad, no time and no session.

import * as v from 'valibot';
import { POSE_MS, poseRefSchema } from './pose.ts';
import { whole, readVersioned, versionedSchema, versionedText, type Read } from '../document/schema.ts';
import type { Robot } from './robot.ts';

/** Which part of an axis counts: all of it with its sign, or one side as if it were a button. */
export const SIDES = ['whole', 'minus', 'plus'] as const;
/** To the right and away from the person. */
const TILT_AXES = ['sideways', 'forward'] as const;

const index = whole(0, 63);
const servo = whole(1, 253);

const inputSchema = v.variant('kind', [
  v.strictObject({ kind: v.literal('axis'), index, side: v.picklist(SIDES) }),
  v.strictObject({ kind: v.literal('button'), index }),
  /** Of a phone that is held like a tray, from how it was held when its tilt began to count. */
  v.strictObject({ kind: v.literal('tilt'), axis: v.picklist(TILT_AXES), side: v.picklist(SIDES) }),
  /** A key by its place on the keyboard, as browsers call it, e.g. `KeyQ`. */
  v.strictObject({ kind: v.literal('key'), code: v.pipe(v.string(), v.minLength(1), v.maxLength(32)) }),
]);

/** The fastest a servo may follow: any servo's whole range in less than a second. */
export const FASTEST_UNITS_PER_S = 3000;
/** Of the end of a limb; a small arm crosses all of its reach in a second or two. */
export const FASTEST_MM_PER_S = 300;
/** Forward, left and up, as in URDF. */
export const TIP_AXES = ['x', 'y', 'z'] as const;

const actionSchema = v.variant('kind', [
  /** Turns on while the input is away from rest; at full deflection by so much, negative the other way. */
  v.strictObject({
    kind: v.literal('rate'),
    servo,
    unitsPerS: whole(-FASTEST_UNITS_PER_S, FASTEST_UNITS_PER_S),
  }),
  /** The input's way is the servo's range. */
  v.strictObject({ kind: v.literal('position'), servo, isReversed: v.boolean() }),
  /** As a rate, of the end of a limb along a straight line. */
  v.strictObject({
    kind: v.literal('tip'),
    axis: v.picklist(TIP_AXES),
    mmPerS: whole(-FASTEST_MM_PER_S, FASTEST_MM_PER_S),
  }),
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
  v.check(({ input, action }) => action.kind !== 'position' || canPlace(input)),
);

/** Releasing a key, or the button that makes a tilt count, must never be what moves a servo. */
export const canPlace = ({ kind }: { readonly kind: Input['kind'] }): boolean =>
  kind === 'axis' || kind === 'button';

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

const bindingsSchema = v.pipe(v.array(bindingSchema), v.maxLength(256));

const tipSchema = v.strictObject({
  /** The bindings move the end of a limb, not its joints. */
  isOn: v.boolean(),
  /** The end stays level where the limb can. */
  isLevel: v.boolean(),
  /** The link at the end of the limb; absent: of the first one. */
  limb: v.exactOptional(v.pipe(v.string(), v.minLength(1), v.maxLength(256))),
  /** The bindings of the other choice: of the joints while it is on, else of the end. */
  others: bindingsSchema,
});

const mappingSchema = v.strictObject({
  bindings: bindingsSchema,
  feel: feelSchema,
  /** Absent until it is used for the first time, and in older texts. */
  tip: v.exactOptional(tipSchema),
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
  readonly tip?: TipChoice;
}
export interface TipChoice {
  readonly isOn: boolean;
  readonly isLevel: boolean;
  readonly limb?: string;
  readonly others: readonly Binding[];
}

/** The servo a binding turns; null where it does something else. */
export function servoBoundBy({ action }: Binding): number | null {
  return 'servo' in action ? action.servo : null;
}

// A mapping as text with a version, and back; for storage. Reading trusts nothing.

const FORMAT = 'servodeck-mapping';

const fileSchema = versionedSchema(FORMAT, mappingSchema);

export const mappingToText = (mapping: Mapping): string => versionedText(FORMAT, mapping);

export function mappingFromText(text: string): Read<Mapping> {
  return readVersioned(text, fileSchema, () => null);
}

// What fingers do at one moment, as plain numbers, and how a stick's way becomes a wish: dead zone, curve, smoothing.

export interface Inputs {
  /** -1 to 1 each. */
  readonly axes: readonly number[];
  /** 0 to 1 each: triggers know how far. */
  readonly buttons: readonly number[];
  /** Codes of the keys that are down. */
  readonly keys: ReadonlySet<string>;
  /** null: it does not count now. */
  readonly tilt: Tilt | null;
}

/** -1 to 1 each. */
export type Tilt = Readonly<Record<(typeof TILT_AXES)[number], number>>;

export const NO_INPUTS: Inputs = { axes: [], buttons: [], keys: new Set(), tilt: null };

/** From here on a button or half an axis counts as pressed. */
const PRESSED = 0.5;

/** How far an input is from rest, -1 to 1. What is not there rests. */
export function valueOf(input: Input, { axes, buttons, keys, tilt }: Inputs): number {
  if (input.kind === 'key') return keys.has(input.code) ? 1 : 0;
  if (input.kind === 'button') return clamped(buttons[input.index] ?? 0, 0, 1);
  const at = input.kind === 'tilt' ? tilt?.[input.axis] : axes[input.index];
  const way = clamped(at ?? 0, -1, 1);
  if (input.side === 'whole') return way;
  return Math.max(0, input.side === 'plus' ? way : -way);
}

export const isPressed = (input: Input, inputs: Inputs): boolean =>
  Math.abs(valueOf(input, inputs)) > PRESSED;

/** What a person has moved since `before`: a button, or the half of an axis or tilt; null while nothing is clear. */
export function movedInput(before: Inputs, now: Inputs): Input | null {
  const button = now.buttons.findIndex((value, at) => value - (before.buttons[at] ?? 0) > PRESSED);
  if (button >= 0) return { kind: 'button', index: button };
  const axis = now.axes.findIndex((value, at) => Math.abs(value - (before.axes[at] ?? 0)) > PRESSED);
  if (axis < 0) return movedTilt(now);
  const side = (now.axes[axis] ?? 0) > (before.axes[axis] ?? 0) ? 'plus' : 'minus';
  return { kind: 'axis', index: axis, side };
}

function movedTilt({ tilt }: Inputs): Input | null {
  const axis = TILT_AXES.find((one) => Math.abs(tilt?.[one] ?? 0) > PRESSED);
  return axis === undefined ? null : { kind: 'tilt', axis, side: (tilt?.[axis] ?? 0) > 0 ? 'plus' : 'minus' };
}

export function clamped(value: number, min: number, max: number): number {
  return Math.min(max, Math.max(min, value));
}

// The mapping a robot has until a person makes another: sticks, triggers and bumpers for its first six servos in the
// order of an arm (servo 1 the gripper, 6 the base), and a pair of keys for each. Moves nothing until it is switched
// on. T stays free: it captures what was just done by hand.

export const READY_FEEL: Feel = { deadZonePercent: 15, curvePercent: 30, smoothingMs: 80, speedPercent: 100 };

/** Of a servo's range, in a second: slow enough to let go in time. */
const RANGE_PERCENT_PER_S = 40;

const axis = (index: number): Input => ({ kind: 'axis', index, side: 'whole' });
const button = (index: number): Input => ({ kind: 'button', index });
const key = (code: string): Input => ({ kind: 'key', code });
const tilt = (along: keyof Tilt): Input => ({ kind: 'tilt', axis: along, side: 'whole' });

/** What turns the servo at that place of the list one way, and what the other; numbers are those of the standard pad. */
const TURNS: readonly { readonly more: readonly Input[]; readonly less: readonly Input[] }[] = [
  { more: [button(7), key('KeyQ')], less: [button(6), key('KeyA')] },
  { more: [button(5), key('KeyW')], less: [button(4), key('KeyS')] },
  { more: [axis(2), key('KeyE')], less: [key('KeyD')] },
  { more: [key('KeyR')], less: [axis(3), key('KeyF')] },
  { more: [tilt('forward'), key('KeyY')], less: [axis(1), key('KeyH')] },
  { more: [axis(0), tilt('sideways'), key('KeyU')], less: [key('KeyJ')] },
];

/** B on most pads, the circle on some. */
const STOP: Binding = { input: button(1), action: { kind: 'stop' } };

export function readyMapping({ servos }: Robot): Mapping {
  const turning = servos.slice(0, TURNS.length).flatMap(({ servo, min, max }, at): readonly Binding[] => {
    const unitsPerS = usualUnitsPerS({ min, max });
    const turn = (input: Input, sign: number): Binding => ({
      input,
      action: { kind: 'rate', servo, unitsPerS: sign * unitsPerS },
    });
    const { more = [], less = [] } = TURNS[at] ?? {};
    return [...more.map((input) => turn(input, 1)), ...less.map((input) => turn(input, -1))];
  });
  return { bindings: [...turning, STOP], feel: READY_FEEL };
}

export function usualUnitsPerS({ min, max }: { readonly min: number; readonly max: number }): number {
  return Math.max(1, Math.round(((max - min) * RANGE_PERCENT_PER_S) / 100));
}

export const isOfTip = ({ tip }: Mapping): boolean => tip?.isOn === true;
