// One moment of driving: what inputs, bindings and the time since the last moment make of each servo; and which bindings get in each
// other's way. Pure; knows neither pad nor session.
//
// An input acts only once it was seen at rest (a position: once it was moved), so that neither switching on nor plugging in
// moves anything. AT_REST forgets what was seen: after it every input has to begin anew.

import type { ServoTarget } from '../codec/commands.ts';
import {
  type Action,
  type Binding,
  type Feel,
  type Input,
  servoBoundBy,
  type SIDES,
  type Mapping,
  clamped,
  isPressed,
  valueOf,
  type Inputs,
} from './mapping.ts';
import { servoOf, type Robot, type RobotServo } from './robot.ts';

type ActionOf<Kind extends Action['kind']> = Extract<Action, { kind: Kind }>;

/** Begun by a press, and done without a finger. */
export type Begun = ActionOf<'pose' | 'run'>;

export interface ServoPlace {
  readonly target: number | null;
  readonly estimated: number | null;
}

export interface Driven {
  readonly mapping: Mapping;
  readonly robot: Robot;
  place(servo: number): ServoPlace;
  /** It stays, whatever is pushed. */
  isLocked(servo: number): boolean;
}

interface Held {
  readonly isAwake: boolean;
  /** How far the input was from rest when it was seen first. */
  readonly firstWay: number;
  /** After curve and smoothing. */
  readonly value: number;
}

export interface DriveState {
  /** By the binding's place in the list. */
  readonly held: readonly Held[];
  /** Targets between two whole units: slow turning needs them. */
  readonly aims: Readonly<Record<number, number>>;
}

export const AT_REST: DriveState = { held: [], aims: {} };

export interface Moment {
  readonly state: DriveState;
  readonly moves: readonly ServoTarget[];
  readonly begun: readonly Begun[];
  /** Servos of the input whose position is unknown. They stay where they are: they need a slow first move. */
  readonly unknown: readonly number[];
  /** Servos of the input that are locked. */
  readonly locked: readonly number[];
  /** Servos that are pushed on where they may be turned no further. */
  readonly atLimit: readonly number[];
  /** Of the end of a limb; null: nothing moves it. */
  readonly tip: TipSpeed | null;
}

/** In millimetres a second forward, left and up. */
export type TipSpeed = readonly [x: number, y: number, z: number];

/** Moves the end of one limb; who knows the limb brings it. */
export interface TipDriver {
  /** The profile that it was made for. */
  readonly robot: Robot;
  /** The link at the end. */
  readonly tip: string;
  readonly servos: readonly number[];
  /** `speed` null: at rest. */
  step(speed: TipSpeed | null, dtMs: number): TipMoment;
}

export interface TipMoment {
  readonly moves: readonly ServoTarget[];
  readonly unknown: readonly number[];
  /** It stays, because it would leave the line or the limits. */
  readonly isShort: boolean;
}

/** How far a position input must be moved before it takes its servo along. */
const PICK_UP = 0.1;
/** A target runs ahead of its servo by no more than this share of the range, so that letting go is stopping. */
export const LEAD = 0.125;

type Staying = 'unknown' | 'locked' | 'atLimit';

interface Wish<To> {
  readonly servo: number;
  readonly wish: To;
}

export function step(driven: Driven, inputs: Inputs, dtMs: number, before = AT_REST): Moment {
  const { bindings } = driven.mapping;
  const held = bindings.map((binding, at) => hold(driven, binding, inputs, dtMs, before.held[at]));
  const wishes = driven.robot.servos.flatMap((servo) => {
    const wish = wishFor(servo, driven, held, before, dtMs);
    return wish === null ? [] : [{ servo: servo.servo, wish }];
  });
  const wished = wishes.filter((one): one is Wish<number> => typeof one.wish === 'number');
  const staying = (why: Staying) => wishes.flatMap(({ servo, wish }) => (wish === why ? [servo] : []));
  return {
    state: { held, aims: Object.fromEntries(wished.map(({ servo, wish }) => [servo, wish])) },
    moves: wished
      .map(({ servo, wish }) => ({ servo, position: Math.round(wish) }))
      .filter(({ servo, position }) => position !== driven.place(servo).target),
    begun: bindings.flatMap(({ action }, at) =>
      isBegun(action) && held[at]?.value === 1 && before.held[at]?.value === 0 ? [action] : [],
    ),
    unknown: staying('unknown'),
    locked: staying('locked'),
    atLimit: staying('atLimit'),
    tip: tipSpeed(driven.mapping, held),
  };
}

function tipSpeed({ bindings, feel }: Mapping, held: readonly Held[]): TipSpeed | null {
  const along = (axis: ActionOf<'tip'>['axis']): number =>
    bindings.reduce((sum, { action }, at) => {
      const movesIt = action.kind === 'tip' && action.axis === axis;
      return movesIt ? sum + (action.mmPerS * feel.speedPercent * (held[at]?.value ?? 0)) / 100 : sum;
    }, 0);
  const speed: TipSpeed = [along('x'), along('y'), along('z')];
  return speed.some((way) => way !== 0) ? speed : null;
}

const isBegun = (action: Action): action is Begun => action.kind === 'pose' || action.kind === 'run';

function hold(
  driven: Driven,
  binding: Binding,
  inputs: Inputs,
  dtMs: number,
  before: Held | undefined,
): Held {
  const { input, action } = binding;
  const { feel } = driven.mapping;
  const way = valueOf(input, inputs);
  const firstWay = before?.firstWay ?? way;
  const wasAwake = before?.isAwake === true;
  if (action.kind === 'position') {
    const isAwake = wasAwake || Math.abs(way - firstWay) > PICK_UP;
    const from = wasAwake ? before.value : shareNow(driven, binding, action);
    return { isAwake, firstWay, value: isAwake ? smoothed(from, shaped(way, feel), dtMs, feel) : from };
  }
  const isRate = action.kind === 'rate' || action.kind === 'tip';
  const wanted = isRate ? shaped(way, feel) : Number(isPressed(input, inputs));
  const isAwake = wasAwake || wanted === 0;
  if (!isAwake || !isRate) return { isAwake, firstWay, value: isAwake ? wanted : 0 };
  // Turning round begins at rest: nothing of the other direction is left.
  const from = wasAwake && before.value * wanted > 0 ? before.value : 0;
  return { isAwake, firstWay, value: smoothed(from, wanted, dtMs, feel) };
}

/** Where a servo is to go, exactly; null where nothing bound to it is moved. */
function wishFor(
  servo: RobotServo,
  driven: Driven,
  held: readonly Held[],
  before: DriveState,
  dtMs: number,
): number | Staying | null {
  const { target, estimated } = driven.place(servo.servo);
  const turned = unitsPerS(servo, driven.mapping, held);
  const placed = placedAt(servo, driven.mapping, held, before);
  if (turned === 0 && placed === null) return null;
  if (driven.isLocked(servo.servo)) return 'locked';
  const known = target ?? estimated;
  if (known === null) return 'unknown';
  // On its slow first move: it is followed once it has arrived.
  if (estimated === null) return null;
  if (placed !== null) return placed;
  const aim = before.aims[servo.servo];
  const from = aim !== undefined && Math.round(aim) === target ? aim : known;
  if (turned > 0 ? from >= servo.max : from <= servo.min) return 'atLimit';
  return led(from, from + (turned * dtMs) / 1000, estimated, servo);
}

/** All that turn a servo, together. */
function unitsPerS({ servo }: RobotServo, { bindings, feel }: Mapping, held: readonly Held[]): number {
  return bindings.reduce((sum, { action }, at) => {
    const turnsIt = action.kind === 'rate' && action.servo === servo;
    return turnsIt ? sum + (action.unitsPerS * feel.speedPercent * (held[at]?.value ?? 0)) / 100 : sum;
  }, 0);
}

/** Where the position input that moved last puts the servo; null while all of them stay. */
function placedAt(
  servo: RobotServo,
  { bindings }: Mapping,
  held: readonly Held[],
  before: DriveState,
): number | null {
  const moved = bindings.flatMap(({ input, action }, at) => {
    if (action.kind !== 'position' || action.servo !== servo.servo || held[at]?.isAwake !== true) return [];
    const place = placeOf(servo, held[at].value, action, input);
    const former = before.held[at];
    const isStill = former?.isAwake === true && placeOf(servo, former.value, action, input) === place;
    return isStill ? [] : [place];
  });
  return moved.at(-1) ?? null;
}

/** Never beyond the servo's limits, and never further ahead of the servo than it was already. */
function led(from: number, to: number, estimated: number, { min, max }: RobotServo): number {
  const lead = (max - min) * LEAD;
  const reach =
    to > from
      ? Math.min(to, Math.max(from, estimated + lead))
      : Math.max(to, Math.min(from, estimated - lead));
  return clamped(reach, min, max);
}

const isSigned = (input: Binding['input']): boolean => input.kind === 'axis' && input.side === 'whole';

function placeOf(
  { min, max }: RobotServo,
  value: number,
  { isReversed }: ActionOf<'position'>,
  input: Binding['input'],
): number {
  const share = isSigned(input) ? (value + 1) / 2 : value;
  return Math.round(min + (isReversed ? 1 - share : share) * (max - min));
}

/** The value that means the servo's present target: smoothing begins there. */
function shareNow({ robot, place }: Driven, { input }: Binding, action: ActionOf<'position'>): number {
  const servo = servoOf(robot, action.servo);
  if (servo === undefined) return 0;
  const { min, max } = servo;
  const { target, estimated } = place(action.servo);
  const along = ((target ?? estimated ?? min) - min) / (max - min);
  const share = action.isReversed ? 1 - along : along;
  return isSigned(input) ? share * 2 - 1 : share;
}

/** An input's way as the person wants it felt: odd, growing, 0 in the dead zone, full at the end. */
export function shaped(way: number, { deadZonePercent, curvePercent }: Feel): number {
  const dead = deadZonePercent / 100;
  const past = Math.max(0, Math.abs(way) - dead) / (1 - dead);
  const bend = curvePercent / 100;
  return Math.sign(way) * ((1 - bend) * past + bend * past ** 3);
}

/** Nearer than this is there: an exponential approach would never end. */
const ARRIVED = 1e-3;

/** From `from` towards `to`, never past it. */
export function smoothed(from: number, to: number, dtMs: number, { smoothingMs }: Feel): number {
  if (smoothingMs === 0) return to;
  const next = from + (to - from) * (1 - Math.exp(-dtMs / smoothingMs));
  return Math.abs(to - next) < ARRIVED ? to : next;
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

/** Whether one movement of a finger would trigger both. */
export function overlaps(one: Input, other: Input): boolean {
  if (one.kind === 'key' || other.kind === 'key')
    return one.kind === 'key' && other.kind === 'key' && one.code === other.code;
  if (one.kind === 'tilt' || other.kind === 'tilt')
    return one.kind === 'tilt' && other.kind === 'tilt' && one.axis === other.axis && areAlike(one, other);
  if (one.kind !== other.kind || one.index !== other.index) return false;
  return one.kind === 'button' || other.kind === 'button' || areAlike(one, other);
}

interface Sided {
  readonly side: (typeof SIDES)[number];
}

function areAlike(one: Sided, other: Sided): boolean {
  return one.side === other.side || one.side === 'whole' || other.side === 'whole';
}
