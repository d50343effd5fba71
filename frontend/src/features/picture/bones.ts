// Hand, humanoid and hexapod as bones between the places of their servos, in a pose. A diagram, not a model: limbs turn, lift and fold so
// that each movement is visible. Pure geometry in percent of the picture.

import { degreesOf, type Robot, type RobotServo } from '#shared/profile/robot.ts';
import { limbsOf, fraction, type Pose } from './pose.ts';

export interface Point {
  readonly x: number;
  readonly y: number;
}

export interface Bone {
  readonly servo: number;
  readonly from: Point;
  readonly to: Point;
  /** False if the position of its servo, or of one that carries it, is unknown. */
  readonly known: boolean;
}

export interface BonePicture {
  /** Palm or trunk. */
  readonly trunk: readonly Point[];
  /** The shadow of a body seen from above: the farther from the trunk, the higher the body. Empty for others. */
  readonly shadow: readonly Point[];
  readonly bones: readonly Bone[];
}

const CENTRE: Point = { x: 50, y: 50 };
/** Above the middle, so that hips are nearer than knees and shoulders nearer than elbows. */
const HUMANOID_CENTRE: Point = { x: 50, y: 30 };
/** Bones that point at the viewer do not vanish. */
const SHORTEST = 0.15;
/** The shadow of a body on the ground, and its distance for each unit of height. */
const SHADOW = { least: 1, each: 0.4 };
/** A hexapod stands on at least three legs. */
const STANDS_ON = 3;
const PALM: Point = { x: 50, y: 62 };
/** Limbs of a humanoid bend towards the viewer; drawn sideways at half the angle they do not overlap. */
const BEND = 0.5;
/** How much of its length a closed finger loses. */
const FOLD = 0.65;
/** Length of a limb's last part, in relation to the bone before it. */
const TIP = 0.7;

/** null for bodies that are not drawn by bones. */
export function bonesOf(robot: Robot, pose: Pose): BonePicture | null {
  if (robot.body === 'humanoid') return humanoid(jointedLimbs(robot), pose);
  if (robot.body === 'hexapod') return hexapod(jointedLimbs(robot), pose);
  return robot.body === 'hand' ? hand(robot.servos, pose) : null;
}

/** The effect of a joint on the rest of its limb. */
interface Turn {
  readonly degrees: number;
  /** Foreshortened length, 0 to 1. */
  readonly length: number;
}

/** From the angles of a limb's joints, up to the last one given, in degrees. */
type Kinematics = (angles: readonly number[]) => Turn;

const bending: Kinematics = (angles) => ({ degrees: sum(angles) * BEND, length: 1 });

/** A bent leg also looks shorter. */
const standing: Kinematics = (angles) => ({ ...bending(angles), length: foreshortened(sum(angles)) });

/** Seen from above the first joint swings the leg, the others lift it. */
const lifting: Kinematics = ([swing = 0, ...lifts]) => ({
  degrees: swing,
  length: foreshortened(sum(lifts)),
});

const foreshortened = (degrees: number): number => Math.max(SHORTEST, Math.abs(Math.cos(radians(degrees))));

/** The servos of a limb, from the trunk on. */
type Chain = readonly RobotServo[];

export interface Limb {
  readonly chain: Chain;
  readonly kinematics: Kinematics;
}

/** The limbs of a humanoid or hexapod; none for other bodies. */
export function jointedLimbs({ body, servos }: Robot): readonly Limb[] {
  if (body === 'hexapod') return chainsOf(servos, CENTRE).map((chain) => ({ chain, kinematics: lifting }));
  if (body !== 'humanoid') return [];
  const kinematicsOf = (chain: Chain): Kinematics => (isLeg(chain) ? standing : bending);
  return chainsOf(servos, HUMANOID_CENTRE).map((chain) => ({ chain, kinematics: kinematicsOf(chain) }));
}

const chainsOf = (servos: readonly RobotServo[], centre: Point): readonly Chain[] =>
  limbsOf(servos).map((limb) =>
    limb.servos.toSorted((one, other) => distance(one.place, centre) - distance(other.place, centre)),
  );

const trunkOf = (limbs: readonly Limb[]): readonly Point[] =>
  aroundMiddle(limbs.map(({ chain }) => rootOf(chain)));

/** Stands on the lower foot: with both legs bent the whole body sinks. */
function humanoid(limbs: readonly Limb[], pose: Pose): BonePicture {
  const posed = (as: Pose): readonly Bone[] => limbs.flatMap((limb) => bonesOfLimb(limb, as));
  const bones = posed(pose);
  const by = { x: 0, y: lowest(posed(() => null)) - lowest(bones) };
  return {
    trunk: trunkOf(limbs).map((corner) => added(corner, by)),
    shadow: [],
    bones: bones.map((bone) => ({ ...bone, from: added(bone.from, by), to: added(bone.to, by) })),
  };
}

/** Legs go far down and hardly sideways. */
export function isLeg(chain: Chain): boolean {
  const [root, tip] = [chain[0], chain.at(-1)];
  if (root === undefined || tip === undefined) return false;
  const { x, y } = vector(root.place, tip.place);
  return y > 2 * Math.abs(x);
}

const lowest = (bones: readonly Bone[]): number => Math.max(0, ...bones.map(({ to }) => to.y));

function hexapod(limbs: readonly Limb[], pose: Pose): BonePicture {
  const trunk = trunkOf(limbs);
  const reaches = limbs.map(({ chain }) => reachDown(chain, pose)).toSorted((one, other) => other - one);
  const height = Math.max(0, reaches[STANDS_ON - 1] ?? 0);
  const offset = SHADOW.least + height * SHADOW.each;
  return {
    trunk,
    shadow: trunk.map((corner) => added(corner, { x: offset, y: offset })),
    bones: limbs.flatMap((limb) => bonesOfLimb(limb, pose)),
  };
}

/** The distance of a foot below its root. The sides are mirrored: an angle that lifts one lowers the other. */
function reachDown(chain: Chain, pose: Pose): number {
  const side = (chain[0]?.place.x ?? 0) < CENTRE.x ? -1 : 1;
  let lift = 0;
  return sum(
    chain.map((servo, index) => {
      if (index > 0) lift += degreesOf(servo, pose(servo.servo) ?? servo.home);
      const { x, y } = restBone(chain, index);
      return Math.hypot(x, y) * Math.sin(radians(lift)) * side;
    }),
  );
}

function bonesOfLimb(limb: Limb, pose: Pose): Bone[] {
  const bones: Bone[] = [];
  let from = rootOf(limb.chain);
  let known = true;
  const angles: number[] = [];
  for (const servo of limb.chain) {
    const position = pose(servo.servo);
    known &&= position !== null;
    angles.push(degreesOf(servo, position ?? servo.home));
    const to = added(from, lastBone(limb, angles));
    bones.push({ servo: servo.servo, from, to, known });
    from = to;
  }
  return bones;
}

/** The bone of the last joint, from its start. */
export function lastBone({ chain, kinematics }: Limb, angles: readonly number[]): Point {
  const { degrees, length } = kinematics(angles);
  return turned(restBone(chain, angles.length - 1), degrees, length);
}

export const rootOf = (chain: Chain): Point => chain[0]?.place ?? CENTRE;

/** From a servo's place to the next one's; the last bone continues the one before it. */
function restBone(chain: Chain, index: number): Point {
  const [here, next, before] = [chain[index], chain[index + 1], chain[index - 1]];
  if (here === undefined) return { x: 0, y: 0 };
  if (next !== undefined) return vector(here.place, next.place);
  return before === undefined ? { x: 0, y: 8 } : turned(vector(before.place, here.place), 0, TIP);
}

export const handBase = (servos: readonly RobotServo[]): RobotServo | undefined =>
  servos.find(({ place }) => place.y > PALM.y);

/** Fingers grow from the palm to their places, and the base turns all of it. */
function hand(servos: readonly RobotServo[], pose: Pose): BonePicture {
  const base = handBase(servos);
  const turn = base === undefined ? 0 : degreesOf(base, pose(base.servo) ?? base.home) * BEND;
  const about = base?.place ?? PALM;
  const seen = (point: Point): Point => added(about, turned(vector(about, point), turn, 1));
  const fingers = servos.filter((servo) => servo !== base);
  const knuckles = fingers.map(({ place }) => added(PALM, turned(vector(PALM, place), 0, 0.45)));
  const bones = fingers.map((finger, index): Bone => {
    const position = pose(finger.servo);
    const from = knuckles[index] ?? PALM;
    const length = position === null ? 1 : 1 - FOLD * Math.min(1, Math.max(0, fraction(position, finger)));
    const to = added(from, turned(vector(from, finger.place), 0, length));
    return { servo: finger.servo, from: seen(from), to: seen(to), known: position !== null };
  });
  if (base !== undefined)
    bones.push({ servo: base.servo, from: base.place, to: seen(PALM), known: pose(base.servo) !== null });
  return {
    trunk: aroundMiddle([...knuckles, { x: 40, y: 74 }, { x: 60, y: 74 }].map(seen)),
    shadow: [],
    bones,
  };
}

/** Sorts the corners around their middle. */
function aroundMiddle(corners: readonly Point[]): readonly Point[] {
  const middle = {
    x: sum(corners.map(({ x }) => x)) / corners.length,
    y: sum(corners.map(({ y }) => y)) / corners.length,
  };
  const angle = (corner: Point): number => Math.atan2(corner.y - middle.y, corner.x - middle.x);
  return corners.toSorted((one, other) => angle(one) - angle(other));
}

function turned({ x, y }: Point, degrees: number, length: number): Point {
  const [sin, cos] = [Math.sin(radians(degrees)), Math.cos(radians(degrees))];
  return { x: (x * cos - y * sin) * length, y: (x * sin + y * cos) * length };
}

const sum = (values: readonly number[]): number => values.reduce((total, value) => total + value, 0);
const radians = (degrees: number): number => (degrees * Math.PI) / 180;
const added = (one: Point, other: Point): Point => ({ x: one.x + other.x, y: one.y + other.y });
const vector = (from: Point, to: Point): Point => ({ x: to.x - from.x, y: to.y - from.y });
const distance = (one: Point, other: Point): number => Math.hypot(one.x - other.x, one.y - other.y);
