// An action group as a document: an immutable list of frames, and what a person says of it. One schema checks its shape. Knows
// no history, no storage, no session; what a board can take is judged where it is compiled and sent. Positions are in the unit
// the group was made for, never converted.
//
// A frame is a moment, `durationMs` after the one before it, and a servo named in it has a key there. A servo that is not named
// continues towards its next key: its way spans the frames between. `easing` is how the servos keyed in a frame come into it, and a
// servo may come in its own way.

import * as v from 'valibot';
import {
  COLOURS,
  type TextFlaw,
  fileReference,
  runningId,
  targetSchema,
  whole,
  readVersioned,
  versionedSchema,
  versionedLine,
  versionedText,
  type Read,
} from '../document/schema.ts';
import type { Frame, ServoTarget } from '../codec/commands.ts';
import { easingSchema, type Easing } from './curves.ts';
import type { Family } from '../codec/families.ts';

export const GROUP_NAME_LENGTH = 64;
export const NOTE_LENGTH = 200;
/** More than that is another motion. */
export const MOST_ERROR_UNITS = 200;
/** Far above any board; keeps a damaged file from filling the memory. */
export const MAX_FRAMES = 10_000;
const MAX_MS = 0xffff * MAX_FRAMES;
const MAX_MARKERS = 1000;
/** Half and double the slowest and the fastest that are found. */
export const [FASTEST_BEAT_MS, SLOWEST_BEAT_MS] = [100, 4000] as const;
const MAX_TAGS = 20;

const keySchema = v.strictObject({
  ...targetSchema.entries,
  /** Left out: as the frame says. */
  easing: v.exactOptional(easingSchema),
});

const frameSchema = v.strictObject({
  /** Distinguishes frames while they move about in the list; never used twice, means nothing outside the document. */
  id: runningId,
  durationMs: whole(0, 0xffff),
  /** In ascending servo order, each servo once. */
  targets: v.array(keySchema),
  easing: easingSchema,
  note: v.pipe(v.string(), v.maxLength(NOTE_LENGTH)),
  colour: v.nullable(v.picklist(COLOURS)),
});

const markerSchema = v.strictObject({
  id: runningId,
  /** Since the group began. */
  atMs: whole(0, MAX_MS),
  text: v.pipe(v.string(), v.maxLength(NOTE_LENGTH)),
});

export const MOST_TIMES = 100;
export const [SLOWEST_PERCENT, FASTEST_PERCENT] = [10, 400] as const;
const MAX_BLOCKS = 200;

/** Motion on a track of its own, above the keys: blocks.ts says what it does. */
const blockSchema = v.strictObject({
  id: runningId,
  name: v.pipe(v.string(), v.maxLength(GROUP_NAME_LENGTH)),
  /** Since the group began. */
  startMs: whole(0, MAX_MS),
  times: whole(1, MOST_TIMES),
  speedPercent: whole(SLOWEST_PERCENT, FASTEST_PERCENT),
  /** How long its servos take to its first keys, and from its last ones back to what they do without it. */
  blendInMs: whole(0, 0xffff),
  blendOutMs: whole(0, 0xffff),
  /** From its last keys to its first ones, where it is repeated. */
  gapMs: whole(0, 0xffff),
  /** In the order of time, the first one at 0. */
  moments: v.pipe(
    v.array(v.strictObject({ atMs: whole(0, MAX_MS), easing: easingSchema, targets: v.array(keySchema) })),
    v.minLength(1),
    v.maxLength(MAX_FRAMES),
  ),
});

/** A sound that is played along. */
const soundSchema = v.strictObject({
  ...fileReference.entries,
  /** When it begins, since the group began; before 0 its beginning is not heard. */
  startMs: whole(-MAX_MS, MAX_MS),
  /** Of the sound, since it began; null: none were found or tapped. */
  beats: v.nullable(
    v.strictObject({
      firstMs: v.pipe(v.number(), v.minValue(0), v.maxValue(SLOWEST_BEAT_MS)),
      everyMs: v.pipe(v.number(), v.minValue(FASTEST_BEAT_MS), v.maxValue(SLOWEST_BEAT_MS)),
    }),
  ),
});

export const groupSchema = v.strictObject({
  name: v.pipe(v.string(), v.maxLength(GROUP_NAME_LENGTH)),
  unit: v.picklist(['us', 'steps']),
  /** The name of the robot it was made for; empty where it was not said. */
  robot: v.pipe(v.string(), v.maxLength(GROUP_NAME_LENGTH)),
  tags: v.pipe(
    v.array(v.pipe(v.string(), v.minLength(1), v.maxLength(GROUP_NAME_LENGTH))),
    v.maxLength(MAX_TAGS),
  ),
  /** Where on the board it belongs; null: nowhere yet. */
  slot: v.nullable(whole(0, 255)),
  /** How often it is played; 0: until stopped. */
  times: whole(0, 0xffff),
  /** How far off its board may be on the way; left out: so little that it cannot be seen. */
  maxErrorUnits: v.optional(whole(1, MOST_ERROR_UNITS)),
  frames: v.pipe(v.array(frameSchema), v.maxLength(MAX_FRAMES)),
  markers: v.pipe(v.array(markerSchema), v.maxLength(MAX_MARKERS)),
  /** The next unused id of a frame or marker: an undone frame comes back as itself. */
  nextId: runningId,
  sound: v.exactOptional(soundSchema),
  blocks: v.exactOptional(v.pipe(v.array(blockSchema), v.maxLength(MAX_BLOCKS))),
});

export type GroupSound = Readonly<v.InferOutput<typeof soundSchema>>;
export type BlockMoment = Readonly<{ atMs: number; easing: Easing; targets: readonly KeyTarget[] }>;
export type Block = Readonly<Omit<v.InferOutput<typeof blockSchema>, 'moments'>> & {
  readonly moments: readonly BlockMoment[];
};
export type Marker = Readonly<v.InferOutput<typeof markerSchema>>;

/** A servo's place in a frame, and how it comes there where it does not come as the frame says. */
export type KeyTarget = ServoTarget & { readonly easing?: Easing };

export type GroupFrame = Readonly<Omit<v.InferOutput<typeof frameSchema>, 'targets' | 'easing'>> & {
  readonly easing: Easing;
  readonly targets: readonly KeyTarget[];
};

/** A servo's own way, else that of its frame. */
export const easingOf = (target: KeyTarget, frame: Pick<GroupFrame, 'easing'>): Easing =>
  target.easing ?? frame.easing;

/** No servo comes in along a curve. */
export const isStraight = (frame: GroupFrame): boolean =>
  frame.easing === 'linear' && frame.targets.every((target) => easingOf(target, frame) === 'linear');

export type ActionGroup = Readonly<
  Omit<v.InferOutput<typeof groupSchema>, 'frames' | 'markers' | 'tags' | 'blocks'>
> & {
  readonly blocks?: readonly Block[];
  readonly frames: readonly GroupFrame[];
  readonly markers: readonly Marker[];
  readonly tags: readonly string[];
};

export function emptyGroup(name: string, unit: ActionGroup['unit']): ActionGroup {
  return { name, unit, robot: '', tags: [], slot: null, times: 1, frames: [], markers: [], nextId: 1 };
}

/** What no shape can say is wrong, as a sentence; null where nothing is. */
export function flawOfGroup({ frames, markers, blocks = [], nextId }: ActionGroup): TextFlaw | null {
  const ids = [...frames, ...markers, ...blocks].map((one) => one.id);
  if (new Set(ids).size < ids.length || ids.some((one) => one >= nextId))
    return { code: 'sameNumber', at: '' };
  const index = frames.findIndex(({ targets }) => !isAscending(targets));
  if (index !== -1) return { code: 'servoOrder', at: String(index + 1) };
  const block = blocks.findIndex((one) => !isInOrder(one));
  return block === -1 ? null : { code: 'badValue', at: `blocks.${block}` };
}

/** Its repeats together are no more keys than a group may have frames. */
const isInOrder = ({ moments, times }: Block): boolean =>
  moments[0]?.atMs === 0 &&
  moments.length * times <= MAX_FRAMES &&
  moments.every(
    ({ atMs, targets }, index) => atMs >= (moments[index - 1]?.atMs ?? 0) && isAscending(targets),
  );

const isAscending = (targets: readonly ServoTarget[]): boolean =>
  targets.slice(1).every(({ servo }, index) => servo > (targets[index]?.servo ?? servo));

/** Whether there is anything to play, download or save: frames, or blocks alone. */
export const holdsMotion = ({ frames, blocks = [] }: Pick<ActionGroup, 'frames' | 'blocks'>): boolean =>
  frames.length + blocks.length > 0;

/** Nominal time of one pass, as the frames ask for it. */
export function totalDurationMs(frames: readonly Frame[]): number {
  return frames.reduce((sum, frame) => sum + frame.durationMs, 0);
}

/** The position of each servo once frame `index` is done: a servo keeps its place until a later frame names it. */
export function poseAt(frames: readonly Frame[], index: number): ReadonlyMap<number, number> {
  const pose = new Map<number, number>();
  for (const frame of frames.slice(0, index + 1)) {
    for (const target of frame.targets) pose.set(target.servo, target.position);
  }
  return pose;
}

/** Servos that frame `index` moves away from where the frames before it left them, in ascending order. */
export function changedServos(frames: readonly Frame[], index: number): readonly number[] {
  const before = poseAt(frames, index - 1);
  const targets = frames[index]?.targets ?? [];
  return targets
    .filter((target) => before.get(target.servo) !== target.position)
    .map((target) => target.servo)
    .sort((one, other) => one - other);
}

// How far a servo may be off its way when a group becomes frames of a board.

/** Too little to be seen: half a degree. */
const USUAL_ERROR = { us: 5, steps: 2 } as const;

/** What the group says, in its own unit. */
export function maxErrorOf({ unit, maxErrorUnits }: ActionGroup, family: Family): number {
  return (unit === family.unit ? maxErrorUnits : undefined) ?? USUAL_ERROR[family.unit];
}

// An action group as text with a version, and back; the same for storage and files. Reading trusts nothing and says
// what is wrong.

const FORMAT = 'servodeck-group';

/** Other programs may use it: docs/group.schema.json. */
export const groupFileSchema = versionedSchema(FORMAT, groupSchema);

export const groupToText = (group: ActionGroup): string => versionedLine(FORMAT, group);

/** The same, for people to read. */
export const groupToFile = (group: ActionGroup): string => versionedText(FORMAT, group);

/** By their values, not by identity of the objects. */
export const sameGroup = (one: ActionGroup, other: ActionGroup): boolean => plain(one) === plain(other);

const plain = (group: ActionGroup): string => JSON.stringify(v.safeParse(groupSchema, group).output);

export function groupFromText(text: string): Read<ActionGroup> {
  return readVersioned(text, groupFileSchema, flawOfGroup);
}
