// A servo's positions as the person reads them, in the board's units or in degrees from its home, and back. Pure.

import type { CSSProperties } from 'react';
import type { Range, Family } from '#shared/codec/families.ts';
import { degreesOf, positionOf, type RobotServo } from '#shared/profile/robot.ts';
import { fraction } from '../picture/pose.ts';
import type { PositionsIn } from '../view.ts';
import { words } from '../../i18n/words.ts';

// Where a servo's limits lie on the track of its slider, and on which side of them their figures stand, so that the
// estimate crosses none where it has come to an end.

/** Between the two ends, outside of both, or both beyond one of them where the track ends at the other. */
type FiguresAt = 'within' | 'around' | 'after' | 'before';

/** Of the narrowest page, so that a way that is wide enough here is so everywhere. */
const NARROWEST_TRACK_PX = 250;
const CHARACTER_PX = 7;
/** Between a figure and an end of the way. */
const BESIDE_PX = 5;

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

/** From where to where the limits lie on the track, as shares of it. */
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
