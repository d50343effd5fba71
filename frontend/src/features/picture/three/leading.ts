// Leading a limb by its end: from a place in space to targets of its servos, within their limits and past the ones that are locked.
// Moves nothing itself. Millimetres are the page's; metres are the model's.

import type { ServoTarget } from '#shared/codec/commands.ts';
import { poseOfChain, type Chain, type ChainPose, type Vec3 } from '#shared/kinematics/chain.ts';
import { follow, reach, type Solution, type Wish } from '#shared/kinematics/inverse.ts';
import { degreesOf, positionOf, type Robot, type RobotServo, servoOf } from '#shared/profile/robot.ts';
import type { LedLimb } from './limbs.ts';

/** Positions in board units; null: not known. */
export type Positions = (servo: RobotServo) => number | null;

export interface Leading {
  readonly limb: LedLimb;
  /** Radians, in the order of the chain. */
  readonly angles: readonly number[];
}

const RADIANS = Math.PI / 180;

export const radiansOf = (servo: RobotServo, position: number): number =>
  degreesOf(servo, position) * RADIANS;

/** Where the limb is as its servos stand; null where one of them stands somewhere unknown. */
export function takeLimb(limb: LedLimb, robot: Robot, positions: Positions): Leading | null {
  const angles: number[] = [];
  for (const number of limb.servos) {
    const servo = servoOf(robot, number);
    const position = servo === undefined ? null : positions(servo);
    if (servo === undefined || position === null) return null;
    angles.push(radiansOf(servo, position));
  }
  return { limb, angles };
}

export const poseOfLimb = ({ limb, angles }: Leading): ChainPose => poseOfChain(limb.chain, angles);

interface Lead extends Wish {
  /** `follow`: the nearest way, for a drag. `reach`: any elbow, for a place that was typed. */
  readonly how: 'follow' | 'reach';
  isLocked(servo: number): boolean;
}

export interface Led {
  readonly leading: Leading;
  readonly targets: readonly ServoTarget[];
  readonly missM: number;
}

export function leadTo(leading: Leading, robot: Robot, { how, isLocked, ...wish }: Lead): Led {
  const { limb, angles } = leading;
  const chain = withLocks(limb, angles, isLocked);
  const { angles: found, missM }: Solution = (how === 'follow' ? follow : reach)(chain, angles, wish);
  const targets = limb.servos.flatMap((number, index): readonly ServoTarget[] => {
    const servo = servoOf(robot, number);
    if (servo === undefined || isLocked(number)) return [];
    const wanted = positionOf(servo, (found[index] ?? 0) / RADIANS);
    return [{ servo: number, position: Math.min(servo.max, Math.max(servo.min, wanted)) }];
  });
  return { leading: { limb, angles: found }, targets, missM };
}

/** A locked joint is one whose limits are where it stands. */
function withLocks({ chain, servos }: LedLimb, angles: readonly number[], isLocked: Lead['isLocked']): Chain {
  const joints = chain.joints.map((joint, index) => {
    const angle = angles[index] ?? 0;
    return isLocked(servos[index] ?? 0) ? { ...joint, min: angle, max: angle } : joint;
  });
  return { ...chain, joints };
}

export const inMm = ([x, y, z]: Vec3): Vec3 => [
  Math.round(x * 1000),
  Math.round(y * 1000),
  Math.round(z * 1000),
];
