// A servo's positions as the person reads them, in the board's units or in degrees from its home, and back. Pure.

import { degreesOf, positionOf, type RobotServo } from '#shared/profile/robot.ts';
import type { Family, Range } from '#shared/codec/families.ts';
import type { PositionsIn } from '../view.ts';
import { words } from '../../i18n/words.ts';

export interface Scale {
  readonly unit: string;
  readonly isDegrees: boolean;
  /** The servo's limits as they are shown. */
  readonly min: number;
  readonly max: number;
  readonly decimals: 0 | 1;
  /** How far arrows and the wheel go; with Shift ten times as far. */
  readonly step: number;
  /** How far the Page keys go. */
  readonly page: number;
  /** -1 where a shown value grows towards the slider's left end. */
  readonly direction: 1 | -1;
  shown(position: number): number;
  /** The nearest position within the limits. */
  position(shown: number): number;
  /** With its unit. */
  text(position: number): string;
  digits(position: number): string;
}

/** A unit finer than this is shown with a tenth of a degree, so that what is shown leads back to the same position. */
const FINE_DEGREES = 0.1;
/** So is a way shorter than this, and gone in small steps: in whole degrees there is next to nothing on it to choose from. */
const SHORT_WAY_DEGREES = 10;

export function scaleOf(servo: RobotServo, { unit }: Pick<Family, 'unit'>, positionsIn: PositionsIn): Scale {
  return positionsIn === 'degrees' ? inDegrees(servo) : inUnits(servo, unit);
}

/** The position after a step of the shown value, within the servo's limits. */
export function stepped(scale: Scale, from: number, change: number): number {
  return scale.position(Math.min(scale.max, Math.max(scale.min, scale.shown(from) + change)));
}

/** Of a servo that the robot at hand does not have, or not in this unit. */
export function inUnits({ min, max }: Range, unit: Family['unit']): Scale {
  return {
    ...{ unit: words.units[unit], min, max, decimals: 0, direction: 1, step: 1 },
    isDegrees: false,
    page: unit === 'us' ? 100 : 50,
    shown: Math.round,
    position: (shown) => within({ min, max }, Math.round(shown)),
    text: (position) => words.position[unit]({ position: Math.round(position) }),
    digits: (position) => words.numbers.formatWhole(Math.round(position)),
  };
}

function inDegrees(servo: RobotServo): Scale {
  const isShort = (servo.max - servo.min) * servo.degreesPerUnit < SHORT_WAY_DEGREES;
  const decimals = isShort || servo.degreesPerUnit <= FINE_DEGREES ? 1 : 0;
  // Adding 0 turns -0, which would be written with its sign, into 0.
  const shown = (position: number): number => Number(degreesOf(servo, position).toFixed(decimals)) + 0;
  const [low, high] = servo.isReversed ? [servo.max, servo.min] : [servo.min, servo.max];
  const [min, max] = [shown(low), shown(high)];
  // What stands for an end leads to it, though the figure was rounded.
  const position = (degrees: number): number => {
    if (degrees <= min) return low;
    return degrees >= max ? high : positionOf(servo, degrees);
  };
  return {
    ...{ unit: '°', min, max, decimals, page: 10 },
    isDegrees: true,
    // Never less than a unit: such a step would stay where it is.
    step: isShort ? Math.ceil(servo.degreesPerUnit * 10) / 10 : 1,
    direction: servo.isReversed ? -1 : 1,
    shown,
    position,
    text: (position) => words.numbers.formatDegrees(shown(position), decimals),
    digits: (position) => words.numbers.formatDegrees(shown(position), decimals),
  };
}

const within = ({ min, max }: Pick<RobotServo, 'min' | 'max'>, position: number): number =>
  Math.min(max, Math.max(min, position));
