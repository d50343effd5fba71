// The limbs of a model that may be led by their ends: the chain of joints from the ground to each tip, and the targets of its servos for
// a place in space, within their limits and past locked ones. Moves nothing. Millimetres are the page's, metres the model's.

import { type Matrix4, type Object3D, Quaternion, Vector3 } from 'three';
import type { URDFRobot } from 'urdf-loader';
import {
  type Chain,
  type ChainJoint,
  type Rotation,
  type Vec3,
  poseOfChain,
  type ChainPose,
} from '#shared/kinematics/chain.ts';
import { carriersOf, isJoint } from './figure.ts';
import { jointName, TIP } from './urdf.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { follow, reach, type Solution, type Wish } from '#shared/kinematics/inverse.ts';
import { degreesOf, positionOf, type Robot, type RobotServo, servoOf } from '#shared/profile/robot.ts';

export interface LedLimb {
  /** The link at its end. */
  readonly tip: string;
  readonly chain: Chain;
  /** In the order of the chain. */
  readonly servos: readonly number[];
}

/** Fewer joints lead nowhere: a place in space takes three. */
const LEAST_JOINTS = 3;

/** Of a model that stands at 0. */
export function limbsOfModel(robot: URDFRobot, servos: readonly number[]): readonly LedLimb[] {
  robot.updateMatrixWorld(true);
  return Object.keys(robot.links)
    .filter((name) => name.startsWith(TIP))
    .flatMap((name) => {
      const link = robot.links[name];
      const limb = link === undefined ? null : limbTo(robot, link, name, servos);
      return limb === null ? [] : [limb];
    });
}

function limbTo(robot: URDFRobot, link: Object3D, tip: string, servos: readonly number[]): LedLimb | null {
  const carriers = carriersOf(link, servos);
  if (carriers.length < LEAST_JOINTS) return null;
  let before = robot.matrixWorld;
  const joints = carriers.flatMap((servo): readonly ChainJoint[] => {
    const name = jointName(servo);
    const joint = robot.joints[name];
    if (joint === undefined || !isJoint(joint)) return [];
    const { at, rotation } = between(before, joint.matrixWorld);
    before = joint.matrixWorld;
    const { lower: min, upper: max } = joint.limit;
    return [{ name, origin: at, rotation, axis: triple(joint.axis), min, max }];
  });
  const { at } = between(before, link.matrixWorld);
  const length = Math.hypot(...at) || 1;
  const pointing: Vec3 = [at[0] / length, at[1] / length, at[2] / length];
  return { tip, servos: carriers, chain: { joints, tip: at, pointing } };
}

function between(from: Matrix4, to: Matrix4): { readonly at: Vec3; readonly rotation: Rotation } {
  const step = from.clone().invert().multiply(to);
  const at = new Vector3();
  step.decompose(at, new Quaternion(), new Vector3());
  const [xx, yx, zx, , xy, yy, zy, , xz, yz, zz] = step.elements;
  return {
    at: triple(at),
    rotation: [
      [xx, xy, xz],
      [yx, yy, yz],
      [zx, zy, zz],
    ],
  };
}

export const triple = ({ x, y, z }: Vector3): Vec3 => [x, y, z];

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
