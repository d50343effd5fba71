// A robot as its owner describes it: which board, which servos with names, limits, home, direction and trim, where they sit on
// the body, what feeds it. One immutable value, checked by one schema; knows no session and no storage.
//
// A servo's position is what the person means by it; the board gets it plus the servo's trim. Both in board units.

import * as v from 'valibot';
import robots from '../../protocol/robots.json' with { type: 'json' };
import { fileReference, placeOf } from '../document/schema.ts';
import type { ServoTarget } from '../codec/commands.ts';
import { FAMILIES, positionRange, type FamilyId, type Range } from '../codec/families.ts';

// Where something has not the shape of a robot: which of its fields, and of which servo, for those who have the words.

const ROBOT_FIELDS = [
  ...(['robot', 'name', 'board', 'body', 'servos'] as const),
  ...(['battery', 'batteryCare', 'policy', 'thresholds', 'warnMv', 'alarmMv', 'supplyMa'] as const),
  ...(['servo', 'group', 'min', 'max', 'home', 'trim'] as const),
  ...(['isReversed', 'degreesPerUnit', 'mirror', 'place', 'joint', 'homeDegrees'] as const),
  ...(['model', 'id', 'fileName', 'end'] as const),
] as const;
export type RobotField = (typeof ROBOT_FIELDS)[number];

/** `field`: what stands there is none that can be. `strangeField`: no robot has such a one. `of`: null where it is of no servo. */
type ShapeFlaw =
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

export const BODIES = ['arm', 'hand', 'humanoid', 'hexapod', 'plain'] as const;
export type BodyKind = (typeof BODIES)[number];

/** `adapter`: a mains adapter or USB, whose volts say nothing of a charge. */
export const BATTERY_KINDS = ['adapter', '2s', '3s'] as const;
export type BatteryKind = (typeof BATTERY_KINDS)[number];

/** What a battery at its alarm brings about, each with what is before it: the person is warned; nothing new is run or played; the
 * robot goes slowly to rest and is stopped. */
export const BATTERY_POLICIES = ['tell', 'refuse', 'rest'] as const;
export type BatteryPolicy = (typeof BATTERY_POLICIES)[number];

export const NAME_LENGTH = robots.nameLength;
export const TRIM: Range = robots.trim;
export const BATTERY_MV: Range = robots.batteryMv;
export const SUPPLY_MA: Range = robots.supplyMa;

const name = v.pipe(v.string(), v.trim(), v.minLength(1), v.maxLength(NAME_LENGTH));
const whole = (range: Range) => v.pipe(v.number(), v.integer(), v.minValue(range.min), v.maxValue(range.max));
const position = whole({ min: 0, max: 2500 });
const familyIds = Object.keys(FAMILIES) as [FamilyId, ...FamilyId[]];

/** As URDF names links and joints. */
const urdfName = v.pipe(v.string(), v.minLength(1), v.maxLength(128));

const jointSchema = v.strictObject({
  name: urdfName,
  /** A positive angle of the servo is a negative one of the joint. */
  isReversed: v.boolean(),
  /** The angle of the joint where the servo is at home. */
  homeDegrees: v.pipe(v.number(), v.minValue(-360), v.maxValue(360)),
});

const modelSchema = v.strictObject({
  ...fileReference.entries,
  /** The link that can be dragged in the picture; null: none. */
  end: v.nullable(urdfName),
});

const servoSchema = v.strictObject({
  servo: whole({ min: 1, max: 253 }),
  name,
  /** Limbs and the like, e.g. `Left leg`; empty for none. */
  group: v.pipe(v.string(), v.maxLength(NAME_LENGTH)),
  min: position,
  max: position,
  /** Where it rests, and 0 degrees. */
  home: position,
  /** A growing position turns it the other way than the body's picture does. */
  isReversed: v.boolean(),
  trim: whole(TRIM),
  degreesPerUnit: v.pipe(v.number(), v.gtValue(0), v.maxValue(2)),
  /** The servo that does the same on the other side of the body. */
  mirror: v.nullable(whole({ min: 1, max: 253 })),
  /** Its place on the body's picture, in percent of width and height. */
  place: v.strictObject({ x: whole({ min: 0, max: 100 }), y: whole({ min: 0, max: 100 }) }),
  /** The joint of the imported model that it turns. */
  joint: v.exactOptional(jointSchema),
});

const batteryCareSchema = v.strictObject({
  policy: v.picklist(BATTERY_POLICIES),
  /** In millivolts; null: as usual for what feeds it. */
  thresholds: v.nullable(v.strictObject({ warnMv: whole(BATTERY_MV), alarmMv: whole(BATTERY_MV) })),
  /** The current that the battery or adapter can give, in milliamperes; absent: unknown. */
  supplyMa: v.exactOptional(whole(SUPPLY_MA)),
});

export const robotSchema = v.strictObject({
  name,
  board: v.picklist(familyIds),
  body: v.picklist(BODIES),
  battery: v.picklist(BATTERY_KINDS),
  batteryCare: batteryCareSchema,
  servos: v.pipe(v.array(servoSchema), v.minLength(1), v.maxLength(253)),
  /** A model in 3D that was imported; without it the picture is made of primitive shapes after `body`. */
  model: v.exactOptional(modelSchema),
});

const anyWhole = v.pipe(v.number(), v.safeInteger());

/** With any numbers for what a servo's reach is made of: one that is out of range has a servo to be named, see `flawOf`. */
export const roughRobotSchema = v.strictObject({
  ...robotSchema.entries,
  servos: v.array(
    v.strictObject({ ...servoSchema.entries, min: anyWhole, max: anyWhole, home: anyWhole, trim: anyWhole }),
  ),
});

export type RobotModel = Readonly<v.InferOutput<typeof modelSchema>>;
export type RobotJoint = Readonly<v.InferOutput<typeof jointSchema>>;
export type RobotServo = Readonly<v.InferOutput<typeof servoSchema>>;
export type Robot = Readonly<Omit<v.InferOutput<typeof robotSchema>, 'servos'>> & {
  readonly servos: readonly RobotServo[];
};

/** What is wrong with a robot, for those who have the words: ranges are what is allowed. */
export type RobotFlaw =
  | { readonly code: 'servoTwice'; readonly servo: number }
  | { readonly code: 'alarmNotBelow'; readonly alarmMv: number; readonly warnMv: number }
  | { readonly code: 'servo'; readonly servo: Pick<RobotServo, 'servo' | 'name'>; readonly flaw: ServoFlaw }
  | ShapeFlaw;

export type ServoFlaw =
  | { readonly code: 'number' | 'beyondBoard'; readonly range: Range }
  | { readonly code: 'minNotBelowMax'; readonly min: number; readonly max: number }
  | { readonly code: 'home' | 'trim'; readonly value: number; readonly range: Range }
  | { readonly code: 'noMirror'; readonly mirror: number };

/** Null where nothing is wrong. */
export function flawOf(robot: Robot): RobotFlaw | null {
  const numbers = robot.servos.map(({ servo }) => servo);
  const twice = numbers.find((servo, index) => numbers.indexOf(servo) < index);
  if (twice !== undefined) return { code: 'servoTwice', servo: twice };
  const { thresholds } = robot.batteryCare;
  if (thresholds !== null && thresholds.alarmMv >= thresholds.warnMv)
    return { code: 'alarmNotBelow', ...thresholds };
  for (const servo of robot.servos) {
    const flaw = flawOfServo(servo, robot);
    if (flaw !== null) return { code: 'servo', servo: { servo: servo.servo, name: servo.name }, flaw };
  }
  const { issues } = v.safeParse(robotSchema, robot);
  return issues === undefined ? null : shapeFlaw(issues[0], robot);
}

function flawOfServo({ servo, min, max, home, trim, mirror }: RobotServo, robot: Robot): ServoFlaw | null {
  const family = FAMILIES[robot.board];
  const board = positionRange(family, servo);
  if (servo < family.servo.min || servo > family.servo.max) return { code: 'number', range: family.servo };
  if (min >= max) return { code: 'minNotBelowMax', min, max };
  if (home < min || home > max) return { code: 'home', value: home, range: { min, max } };
  if (trim < TRIM.min || trim > TRIM.max) return { code: 'trim', value: trim, range: TRIM };
  if (min + trim < board.min || max + trim > board.max) return { code: 'beyondBoard', range: board };
  if (mirror !== null && !robot.servos.some((other) => other.servo === mirror))
    return { code: 'noMirror', mirror };
  return null;
}

export function servoOf(robot: Robot, servo: number): RobotServo | undefined {
  return robot.servos.find((one) => one.servo === servo);
}

/** A target that the robot must not reach, with the servo it is for and what that may do. */
export interface LimitRefusal {
  readonly servo: RobotServo;
  readonly position: number;
}

/** The first target outside its servo's limits. Servos that the robot does not have are the board's affair. */
export function refusedTarget(robot: Robot, targets: readonly ServoTarget[]): LimitRefusal | null {
  for (const { servo: number, position: wanted } of targets) {
    const servo = servoOf(robot, number);
    if (servo !== undefined && (wanted < servo.min || wanted > servo.max)) return { servo, position: wanted };
  }
  return null;
}

/** As the board counts: with each servo's trim. */
export function onBoard(robot: Robot, targets: readonly ServoTarget[]): readonly ServoTarget[] {
  return targets.map(({ servo, position: wanted }) => ({
    servo,
    position: wanted + (servoOf(robot, servo)?.trim ?? 0),
  }));
}

/** Each servo's limits as the board counts, and the trim that is in them. */
export function limitsOnBoard(robot: Robot): readonly NamedLimits[] {
  return robot.servos.map(({ servo, name: called, min, max, trim }) => ({
    ...{ servo, name: called },
    min: min + trim,
    max: max + trim,
    trim,
  }));
}

interface NamedLimits extends Range {
  readonly servo: number;
  readonly name: string;
  readonly trim: number;
}

/** What the person means by a position of the board. */
export function fromBoard(robot: Robot, servo: number, onBoardAt: number): number {
  return onBoardAt - (servoOf(robot, servo)?.trim ?? 0);
}

/** Away from home, in the servo's own direction. */
export function degreesOf({ home, degreesPerUnit, isReversed }: RobotServo, at: number): number {
  return (at - home) * degreesPerUnit * (isReversed ? -1 : 1);
}

/** The nearest position in board units. */
export function positionOf({ home, degreesPerUnit, isReversed }: RobotServo, degrees: number): number {
  return Math.round(home + (degrees * (isReversed ? -1 : 1)) / degreesPerUnit);
}

/** The position that looks the same on the other side: as far from the partner's home, turned the same way by the body. */
export function mirrored(from: RobotServo, to: RobotServo, at: number): number {
  const wanted = positionOf(to, degreesOf(from, at));
  return Math.min(to.max, Math.max(to.min, wanted));
}
