// What a program gets to see: servos with their names and degrees, and snapshots, as backend/servodeck/client/values.py has them. Knows
// the documents of robots as the library stores them, and the usual servos of each family; no request.

import { FAMILIES } from '../codec/families.ts';
import { GatewayError } from './errors.ts';
import type { WelcomeMessage } from './messages.generated.ts';
import { isRecord } from './request.ts';

/** `min`, `max` and `home` are in the board's unit, as the board counts; `home` is 0 degrees. */
export interface Servo {
  readonly number: number;
  readonly name: string;
  readonly min: number;
  readonly max: number;
  readonly home: number;
  /** Below 0 where a growing position turns it the other way. */
  readonly degreesPerUnit: number;
}

export const positionAt = (servo: Servo, degrees: number): number =>
  Math.round(servo.home + degrees / servo.degreesPerUnit);

export const degreesAt = (servo: Servo, position: number): number =>
  (position - servo.home) * servo.degreesPerUnit;

export interface Snapshot {
  readonly board: string;
  readonly link: WelcomeMessage['link']['status'];
  readonly isLatched: boolean;
  readonly driver: string | null;
  readonly batteryMv: number | null;
  /** Where each servo is, or is moving to, so far as that is known; by servo number. */
  readonly targets: Readonly<Record<number, number>>;
  /** The names of the groups in the board's slots that the gateway knows, by slot. */
  readonly groups: Readonly<Record<number, string>>;
  /** The gateway's whole state. */
  readonly raw: WelcomeMessage;
}

export function snapshotOf(welcome: WelcomeMessage): Snapshot {
  const { motion, battery, slotVersions } = welcome;
  const reported = motion.reported.filter(({ isCurrent }) => isCurrent);
  return {
    board: welcome.board,
    link: welcome.link.status,
    isLatched: welcome.latch,
    driver: welcome.lease.driver,
    batteryMv: 'batteryMv' in battery ? battery.batteryMv : null,
    targets: {
      ...Object.fromEntries(motion.servos.map(({ servo, target }) => [servo, target])),
      ...Object.fromEntries(reported.map(({ servo, position }) => [servo, position])),
    },
    groups: Object.fromEntries(Object.entries(slotVersions).map(([slot, { name }]) => [slot, name])),
    raw: welcome,
  };
}

/** As the library has a robot; the parts that a program needs. */
interface StoredServo {
  readonly servo: number;
  readonly name: string;
  readonly min: number;
  readonly max: number;
  readonly home: number;
  readonly trim: number;
  readonly isReversed: boolean;
  readonly degreesPerUnit: number;
}

/** Of a robot's document: a file of the page's export, or the text in the library. Throws a GatewayError. */
export function servosIn(text: string): readonly Servo[] {
  const document = parsed(text);
  const { kit } = document;
  const { robot } = isRecord(kit) ? parsed(String(kit.robot)) : document;
  if (!isRecord(robot) || !Array.isArray(robot.servos)) throw damaged();
  return (robot.servos as readonly StoredServo[]).map((one) => ({
    number: one.servo,
    name: one.name,
    min: one.min + one.trim,
    max: one.max + one.trim,
    home: one.home + one.trim,
    degreesPerUnit: one.degreesPerUnit * (one.isReversed ? -1 : 1),
  }));
}

function parsed(text: string): Record<string, unknown> {
  try {
    const value: unknown = JSON.parse(text);
    if (isRecord(value)) return value;
  } catch {
    // said below
  }
  throw damaged();
}

const damaged = (): GatewayError =>
  new GatewayError('damaged', 'The description of the robot cannot be read.');

/** Of the usual servos, where no robot is on the board (shared/src/profile/readyRobots.ts). */
const DEGREES_PER_UNIT = { us: 0.09, steps: 0.24 };

/** Throws a GatewayError for a name that no servo or several servos have. */
export function numberOf(servos: readonly Servo[], servo: string): number {
  const exact = servos.filter(({ name }) => name === servo);
  const found =
    exact.length > 0 ? exact : servos.filter(({ name }) => name.toLowerCase() === servo.toLowerCase());
  const [first] = found;
  if (first === undefined && /^\d+$/.test(servo)) return Number(servo);
  if (first !== undefined && found.length === 1) return first.number;
  const names = servos.map(({ name }) => name).join(', ') || 'no names';
  const problem = found.length > 1 ? 'Several servos are' : 'No servo is';
  throw new GatewayError('notFound', `${problem} called ${servo}. The robot on the board has: ${names}.`);
}

/** In the board's unit; of a board without a robot, by its usual servos. Throws a GatewayError where the board is unknown. */
export function positionOf(servos: readonly Servo[], board: string, number: number, degrees: number): number {
  const known = servos.find((servo) => servo.number === number);
  if (known) return positionAt(known, degrees);
  const family = Object.values(FAMILIES).find(({ id }) => id === board);
  if (servos.length > 0 || family === undefined)
    throw new GatewayError(
      'outOfRange',
      `Degrees of servo ${number} are unknown: the robot does not describe it.`,
    );
  return Math.round(family.centre + degrees / DEGREES_PER_UNIT[family.unit]);
}
