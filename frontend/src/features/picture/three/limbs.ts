// The limbs of a model that may be led by their ends: the chain of joints from the ground to each tip, and the targets of its servos for a
// place in space, within their limits and past locked ones; and the way of an end through a group. Moves nothing. Millimetres are the
// page's, metres the model's.

import { motionTracks } from '#shared/group/blocks.ts';
import {
  type Matrix4,
  type Object3D,
  Quaternion,
  Vector3,
  BufferAttribute,
  BufferGeometry,
  Color,
  Line,
  LineBasicMaterial,
} from 'three';
import type { URDFRobot } from 'urdf-loader';
import {
  type Chain,
  type ChainJoint,
  type Rotation,
  type Vec3,
  poseOfChain,
  type ChainPose,
} from '#shared/kinematics/model.ts';
import { carriersOf, isJoint } from './figure.ts';
import { jointName, TIP } from './urdf.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { flip, follow, reach, type Solution, type Wish } from '#shared/kinematics/inverse.ts';
import { degreesOf, positionOf, type Robot, type RobotServo, servoOf } from '#shared/profile/robot.ts';
import type { ActionGroup } from '#shared/group/group.ts';
import { timesOf } from '#shared/group/groupTimes.ts';
import { poseAtMs } from '#shared/group/tracks.ts';
import { rescaled } from '#shared/profile/units.ts';
import type { Family } from '#shared/codec/families.ts';

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

/** `follow`: the nearest way, for a hand that has moved by so much. `reach`: any elbow, for a place that was typed. */
export type LeadMode = { readonly how: 'follow'; readonly askedM: number } | { readonly how: 'reach' };

interface Lead extends Wish {
  readonly mode: LeadMode;
  isLocked(servo: number): boolean;
}

export interface Led {
  readonly leading: Leading;
  readonly targets: readonly ServoTarget[];
  readonly missM: number;
}

export function leadTo(leading: Leading, robot: Robot, { mode, isLocked, ...wish }: Lead): Led {
  const { limb, angles } = leading;
  const chain = withLocks(limb, angles, isLocked);
  const { angles: found, missM }: Solution =
    mode.how === 'follow' ? follow(chain, angles, wish, mode.askedM) : reach(chain, angles, wish);
  const targets = targetsOf(limb, robot, found, isLocked);
  return { leading: { limb, angles: found }, targets, missM };
}

function targetsOf(
  { servos }: LedLimb,
  robot: Robot,
  angles: readonly number[],
  isLocked: Lead['isLocked'],
): readonly ServoTarget[] {
  return servos.flatMap((number, index): readonly ServoTarget[] => {
    const servo = servoOf(robot, number);
    if (servo === undefined || isLocked(number)) return [];
    const wanted = positionOf(servo, (angles[index] ?? 0) / RADIANS);
    return [{ servo: number, position: Math.min(servo.max, Math.max(servo.min, wanted)) }];
  });
}

/** The same place with the elbow bent the other way; null: this arm cannot, as it stands. */
export function flipElbow(
  leading: Leading,
  robot: Robot,
  { isLocked, rise }: Pick<Lead, 'isLocked' | 'rise'>,
) {
  const found = flip(withLocks(leading.limb, leading.angles, isLocked), leading.angles, rise);
  return found === null ? null : targetsOf(leading.limb, robot, found.angles, isLocked);
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

export interface PathPoint {
  readonly atMs: number;
  /** Metres from the middle of the base. */
  readonly tip: Vec3;
}

const EACH_MS = 40;
const MOST_POINTS = 500;

/** From the first pose on: where the robot comes from before it is not known. Servos without a key are at home. */
export function pathOf(
  limb: LedLimb,
  robot: Robot,
  group: ActionGroup,
  unit: Family['unit'],
): readonly PathPoint[] {
  const { lengthMs: toMs, tracks: own } = timesOf(group);
  const tracks = motionTracks(group, own);
  const fromMs = Math.min(...[...tracks.values()].map(({ keys }) => keys[0]?.atMs ?? toMs));
  if (fromMs >= toMs) return [];
  const count = Math.min(MOST_POINTS, Math.ceil((toMs - fromMs) / EACH_MS) + 1);
  return Array.from({ length: count }, (_, index) => {
    const atMs = fromMs + ((toMs - fromMs) * index) / (count - 1);
    const pose = poseAtMs(tracks, atMs);
    const angles = limb.servos.map((number) => {
      const [servo, at] = [servoOf(robot, number), pose.get(number)];
      return servo === undefined || at === undefined ? 0 : radiansOf(servo, rescaled(at, group.unit, unit));
    });
    return { atMs, tip: poseOfChain(limb.chain, angles).tip };
  });
}

/** When it first goes below the floor; null where it never does. */
export const belowFloorAtMs = (path: readonly PathPoint[]): number | null =>
  path.find(({ tip }) => tip[2] < 0)?.atMs ?? null;

export interface PathLine {
  readonly line: Object3D;
  paint(above: string, below: string): void;
  dispose(): void;
}

export function createPathLine(path: readonly PathPoint[]): PathLine {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(path.flatMap(({ tip }) => tip)), 3));
  const colours = new BufferAttribute(new Float32Array(path.length * 3), 3);
  geometry.setAttribute('color', colours);
  const material = new LineBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.85 });
  return {
    line: new Line(geometry, material),
    paint(above, below) {
      const [usual, warning] = [new Color(above), new Color(below)];
      for (const [index, { tip }] of path.entries()) {
        const { r, g, b } = tip[2] < 0 ? warning : usual;
        colours.setXYZ(index, r, g, b);
      }
      colours.needsUpdate = true;
    },
    dispose() {
      geometry.dispose();
      material.dispose();
    },
  };
}
