// The limbs of a model that may be led by their ends: the chain of joints from the ground to each tip, and the servo of each joint.

import { type Matrix4, type Object3D, Quaternion, Vector3 } from 'three';
import type { URDFRobot } from 'urdf-loader';
import { type Chain, type ChainJoint, type Rotation, type Vec3 } from '#shared/kinematics/chain.ts';
import { carriersOf, isJoint } from './figure.ts';
import { jointName, TIP } from './urdf.ts';

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
