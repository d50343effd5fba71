// Converts a servo's positions to the displayed unit (board units or degrees from home) and back. Pure.

import type { CSSProperties } from 'react';
import type { Range, Family } from '#shared/codec/families.ts';
import { degreesOf, positionOf, type RobotServo } from '#shared/profile/robot.ts';
import { fraction } from '../picture/pose.ts';
import type { PositionsIn } from '../view.ts';
import { words } from '../../i18n/words.ts';

/** Where the numbers of the limits stand: between the limits, outside both, or both on one side at an end of the track. */
type FiguresAt = 'within' | 'around' | 'after' | 'before';

/** On the narrowest page: a range that is wide enough here is wide enough everywhere. */
const NARROWEST_TRACK_PX = 250;
const CHARACTER_PX = 7;
/** Between a number and its limit. */
const BESIDE_PX = 5;

/** Places the numbers so that the estimate does not cross one when it reaches a limit. */
export function figuresAt(
  limits: Range,
  range: Range,
  [lowest, highest]: readonly [string, string],
): FiguresAt {
  const { from, to } = shares(limits, range);
  const gapPx = 2 * BESIDE_PX;
  if (widthPx(lowest + highest) + 2 * gapPx <= (to - from) * NARROWEST_TRACK_PX) return 'within';
  if (widthPx(lowest) + BESIDE_PX > from * NARROWEST_TRACK_PX) return 'after';
  return widthPx(highest) + BESIDE_PX > (1 - to) * NARROWEST_TRACK_PX ? 'before' : 'around';
}

/** The limits on the track as CSS, in fractions of the track. */
export const between = (limits: Range, range: Range): CSSProperties => {
  const { from, to } = shares(limits, range);
  return { ['--from' as string]: from.toFixed(4), ['--to' as string]: to.toFixed(4) };
};

const shares = ({ min, max }: Range, range: Range): { readonly from: number; readonly to: number } => ({
  from: Math.max(0, fraction(min, range)),
  to: Math.min(1, fraction(max, range)),
});

const widthPx = (figures: string): number => figures.length * CHARACTER_PX;

export interface Scale {
  readonly unit: string;
  readonly isDegrees: boolean;
  /** The servo's limits in the displayed unit. */
  readonly min: number;
  readonly max: number;
  readonly decimals: 0 | 1;
  /** Step of arrow keys and wheel; ten times as much with Shift. */
  readonly step: number;
  /** Step of the Page keys. */
  readonly page: number;
  /** -1 if displayed values grow towards the left end of the slider. */
  readonly direction: 1 | -1;
  shown(position: number): number;
  /** The nearest position within the limits. */
  position(shown: number): number;
  /** With its unit. */
  text(position: number): string;
  digits(position: number): string;
}

/** Units finer than this are displayed in tenths of a degree, so that the displayed value leads back to the same position. */
const FINE_DEGREES = 0.1;
/** Ranges shorter than this are displayed in tenths as well, with small steps: whole degrees would leave hardly any choice. */
const SHORT_WAY_DEGREES = 10;

export function scaleOf(servo: RobotServo, { unit }: Pick<Family, 'unit'>, positionsIn: PositionsIn): Scale {
  return positionsIn === 'degrees' ? inDegrees(servo) : inUnits(servo, unit);
}

/** The position after a step of the displayed value, within the servo's limits. */
export function stepped(scale: Scale, from: number, change: number): number {
  return scale.position(Math.min(scale.max, Math.max(scale.min, scale.shown(from) + change)));
}

/** For a servo that the current robot lacks or has in another unit. */
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
  // Adding 0 turns -0 into 0, which is displayed without a sign.
  const shown = (position: number): number => Number(degreesOf(servo, position).toFixed(decimals)) + 0;
  const [low, high] = servo.isReversed ? [servo.max, servo.min] : [servo.min, servo.max];
  const [min, max] = [shown(low), shown(high)];
  // The displayed value of a limit leads to the limit, although it is rounded.
  const position = (degrees: number): number => {
    if (degrees <= min) return low;
    return degrees >= max ? high : positionOf(servo, degrees);
  };
  return {
    ...{ unit: '°', min, max, decimals, page: 10 },
    isDegrees: true,
    // At least one unit: a smaller step would not move.
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
