// Buttons for everyone: each one is a list of steps (go to a pose, run a slot, wait) with a name, a colour and perhaps a key.
// One immutable page of a robot, checked by one schema. Poses are named by reference. Knows no session and no storage.

import * as v from 'valibot';
import {
  COLOURS,
  type TextFlaw,
  runningId,
  whole,
  readVersioned,
  versionedSchema,
  versionedText,
  type Read,
} from '../document/schema.ts';
import { POSE_MS, poseRefSchema } from './pose.ts';
import { NAME_LENGTH } from './robot.ts';

export const WAIT_MS = { min: 100, max: 600_000 } as const;
export const SLOT = { min: 0, max: 255 } as const;
export const SLOT_TIMES = { min: 1, max: 255 } as const;
/** A page for fingers: more are not found. */
const MAX_MACROS = 200;
const MAX_STEPS = 100;

const stepSchema = v.variant('kind', [
  v.strictObject({
    kind: v.literal('pose'),
    pose: poseRefSchema,
    durationMs: whole(POSE_MS.min, POSE_MS.max),
  }),
  /** Without end is no step: the next one would never come. */
  v.strictObject({
    kind: v.literal('slot'),
    slot: whole(SLOT.min, SLOT.max),
    times: whole(SLOT_TIMES.min, SLOT_TIMES.max),
  }),
  v.strictObject({ kind: v.literal('wait'), waitMs: whole(WAIT_MS.min, WAIT_MS.max) }),
]);

const macroSchema = v.strictObject({
  /** Never used twice; means nothing outside its page. */
  id: runningId,
  name: v.pipe(v.string(), v.trim(), v.minLength(1), v.maxLength(NAME_LENGTH)),
  colour: v.picklist(COLOURS),
  /** One sign in lower case, as `keyOf` gives it; null for none. */
  key: v.nullable(v.pipe(v.string(), v.minLength(1), v.maxLength(2))),
  steps: v.pipe(v.array(stepSchema), v.maxLength(MAX_STEPS)),
});

const macroPageSchema = v.strictObject({
  macros: v.pipe(v.array(macroSchema), v.maxLength(MAX_MACROS)),
  nextId: runningId,
});

export type MacroStep = Readonly<v.InferOutput<typeof stepSchema>>;

export type Macro = Readonly<Omit<v.InferOutput<typeof macroSchema>, 'steps'>> & {
  readonly steps: readonly MacroStep[];
};

export interface MacroPage {
  readonly macros: readonly Macro[];
  readonly nextId: number;
}

export const EMPTY_PAGE: MacroPage = { macros: [], nextId: 1 };

export function macroOf(page: MacroPage, macroId: number | null): Macro | undefined {
  return page.macros.find((macro) => macro.id === macroId);
}

/** The key as it is stored; null for keys that no button may have: those that name something, and the space bar. */
export function keyOf(pressed: string): string | null {
  const key = pressed.toLowerCase();
  return /^\S$/u.test(key) ? key : null;
}

/** What cannot be on a page; null where nothing is wrong. */
function flawOfPage({ macros, nextId }: MacroPage): TextFlaw | null {
  const ids = macros.map((macro) => macro.id);
  if (new Set(ids).size < ids.length || ids.some((one) => one >= nextId))
    return { code: 'sameNumber', at: '' };
  const noKey = macros.findIndex(({ key }) => key !== null && keyOf(key) !== key);
  if (noKey !== -1) return { code: 'badValue', at: `content.macros.${noKey}.key` };
  for (const [index, { key, name }] of macros.entries()) {
    const first = macros.slice(0, index).find((one) => key !== null && one.key === key);
    if (first !== undefined) return { code: 'sameKey', at: `${key?.toUpperCase()}: ${first.name}, ${name}` };
  }
  return null;
}

// A page of buttons as text with a version, and back; for storage. Reading trusts nothing.

const FORMAT = 'servodeck-buttons';

const fileSchema = versionedSchema(FORMAT, macroPageSchema);

export const macroPageToText = (page: MacroPage): string => versionedText(FORMAT, page);

export function macroPageFromText(text: string): Read<MacroPage> {
  return readVersioned(text, fileSchema, flawOfPage);
}
