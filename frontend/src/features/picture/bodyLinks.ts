// Arm, hand, humanoid and hexapod as links made from primitive shapes, for a robot that brings no model of its own. Metres and radians.
// Sizes are those of common robots: to steer by and to estimate by, not a measurement. Knows no drawing.

import type { LinkModel, LinkMount, LinkShape, ModelLink } from '#shared/kinematics/model.ts';
import { type Robot, type RobotServo, servoOf } from '#shared/profile/robot.ts';
import { isLeg, jointedLimbs } from './bones.ts';
import { JOINT } from './pose.ts';

type Triple = readonly [number, number, number];

interface Part {
  readonly shape: 'box' | 'cylinder' | 'sphere';
  /** Box: x, y, z. Cylinder: radius, length along z. Sphere: radius. */
  readonly size: readonly number[];
  readonly at?: Triple;
  readonly turned?: Triple;
  /** `servo`: the case of a servo; else what it carries. */
  readonly kind?: 'servo';
}

interface Mount {
  readonly on: string;
  readonly at: Triple;
  readonly turned?: Triple;
  readonly axis: Triple;
}

const QUARTER = Math.PI / 2;
const UP: Triple = [0, 0, 1];
/** The axes as the flat pictures turn: clockwise from above, from the front and from the right. */
const YAW: Triple = [0, 0, -1];
const ROLL: Triple = [-1, 0, 0];
const PITCH: Triple = [0, 1, 0];

export interface BodyLink extends ModelLink {
  readonly shapes: readonly BodyShape[];
  /** `follows`: it turns with a joint that the servo turns. `tip`: a hand or foot ends there. */
  readonly joint: 'none' | 'servo' | 'follows' | 'fixed' | 'tip';
}

/** `servo`: the case of a servo; else what it carries. */
type BodyShape = LinkShape & Pick<Part, 'shape' | 'kind'>;

/** For estimates of where the robot may touch itself; null for bodies without a description, and where the owner has imported another. */
export function linkModelOf(robot: Robot): LinkModel | null {
  const links = robot.model === undefined ? bodyLinks(robot) : null;
  return links === null ? null : { links, standsOnFloor: robot.body === 'arm' || robot.body === 'hand' };
}

/** Each behind the one that carries it; null for bodies without a description. */
export function bodyLinks(robot: Robot): readonly BodyLink[] | null {
  switch (robot.body) {
    case 'arm':
      return arm(robot);
    case 'hand':
      return hand(robot);
    case 'humanoid':
      return humanoid(robot);
    case 'hexapod':
      return hexapod(robot);
    case 'plain':
      return null;
  }
}

const ARM = { foot: 0.03, shoulder: 0.045, upper: 0.104, fore: 0.089, roll: 0.05, grip: 0.095 };
/** Each jaw turns by so much of what its servo does, from half open. */
const JAW = { share: -0.22, offset: 0.36, length: 0.05 };

/** Straight up at home, as six-servo arms are. */
function arm(robot: Robot): readonly BodyLink[] {
  const turned = (servo: number, name: string, mount: Mount, parts: readonly Part[]): BodyLink =>
    turnedLink(robot, servo, name, mount, parts);
  return [
    baseLink([
      { shape: 'cylinder', size: [0.05, 0.012], at: [0, 0, 0.006] },
      { shape: 'cylinder', size: [0.034, 0.018], at: [0, 0, 0.021], kind: 'servo' },
    ]),
    turned(JOINT.base, 'turret', { on: 'base_link', at: [0, 0, ARM.foot], axis: YAW }, [
      { shape: 'box', size: [0.05, 0.046, 0.03], at: [0, 0, 0.02] },
      axle(0.017, 0.056, [0, 0, ARM.shoulder]),
    ]),
    turned(JOINT.shoulder, 'upper_arm', { on: 'turret', at: [0, 0, ARM.shoulder], axis: PITCH }, [
      bar(0.026, 0.036, ARM.upper),
      axle(0.015, 0.05, [0, 0, ARM.upper]),
    ]),
    turned(JOINT.elbow, 'fore_arm', { on: 'upper_arm', at: [0, 0, ARM.upper], axis: PITCH }, [
      bar(0.022, 0.03, ARM.fore),
      axle(0.013, 0.044, [0, 0, ARM.fore]),
    ]),
    turned(JOINT.wrist, 'wrist', { on: 'fore_arm', at: [0, 0, ARM.fore], axis: PITCH }, [
      { shape: 'box', size: [0.024, 0.028, 0.036], at: [0, 0, 0.024], kind: 'servo' },
    ]),
    turned(JOINT.roll, 'palm', { on: 'wrist', at: [0, 0, ARM.roll], axis: YAW }, [
      { shape: 'cylinder', size: [0.012, 0.01], at: [0, 0, 0] },
      { shape: 'box', size: [0.022, 0.05, 0.02], at: [0, 0, 0.015] },
    ]),
    turned(JOINT.gripper, 'gripper_horn', { on: 'palm', at: [0, 0, 0.02], axis: ROLL }, []),
    ...([1, -1] as const).flatMap((side) => [
      followingLink(
        JOINT.gripper,
        JAW,
        `jaw_${side}`,
        { on: 'palm', at: [0, side * 0.014, 0.025], axis: [-side, 0, 0] },
        [
          { shape: 'box', size: [0.016, 0.009, JAW.length], at: [0, side * 0.006, JAW.length / 2] },
          {
            shape: 'box',
            size: [0.014, 0.008, 0.026],
            at: [0, side * 0.001, JAW.length + 0.008],
            turned: [side * 0.36, 0, 0],
          },
        ],
      ),
    ]),
    tip('grip', 'wrist', [0, 0, ARM.roll + ARM.grip]),
  ];
}

/** A closed finger turns each of its two bones by a quarter. */
const FINGER = { share: 0.5, offset: QUARTER / 2, first: 0.045, second: 0.036 };

/** Fingers grow up from the palm to their places on the flat picture; the base turns all of it. */
function hand(robot: Robot): readonly BodyLink[] {
  const base = robot.servos.find(({ place }) => place.y > 70);
  const fingers = robot.servos.filter((servo) => servo !== base);
  return [
    baseLink([{ shape: 'cylinder', size: [0.035, 0.02], at: [0, 0, 0.01], kind: 'servo' }]),
    turnedLink(robot, base?.servo ?? null, 'palm', { on: 'base_link', at: [0, 0, 0.02], axis: YAW }, [
      { shape: 'cylinder', size: [0.02, 0.03], at: [0, 0, 0.015] },
      { shape: 'box', size: [0.026, 0.084, 0.075], at: [0, 0, 0.065] },
    ]),
    ...fingers.flatMap(({ servo, place }) => {
      const [across, up] = [(50 - place.x) * 0.0011, (52 - place.y) * 0.0004];
      const mount = {
        at: [0, across, 0.1 + up] as Triple,
        turned: [across * -7, 0, 0] as Triple,
        axis: PITCH,
      };
      const [near, far] = [`finger_${servo}`, `finger_end_${servo}`];
      return [
        turnedLink(robot, servo, `horn_${servo}`, { on: 'palm', ...mount }, []),
        followingLink(servo, FINGER, near, { on: 'palm', ...mount }, [
          axle(0.008, 0.016, [0, 0, 0]),
          bar(0.014, 0.014, FINGER.first),
        ]),
        followingLink(servo, FINGER, far, { on: near, at: [0, 0, FINGER.first], axis: PITCH }, [
          axle(0.007, 0.015, [0, 0, 0]),
          bar(0.012, 0.012, FINGER.second),
        ]),
      ];
    }),
  ];
}

interface Segment {
  /** To the next joint, or to the tip. */
  readonly to: Triple;
  readonly axis: Triple;
  readonly turned?: Triple;
}

const HUMANOID = { hip: 0.19, trunk: 0.12, shoulder: 0.1 };
const LEG: readonly Segment[] = [
  { axis: ROLL, to: [0, 0, -0.024] },
  { axis: PITCH, to: [0, 0, -0.062] },
  { axis: PITCH, to: [0, 0, -0.062] },
  { axis: PITCH, to: [0, 0, -0.024] },
  { axis: ROLL, to: [0, 0, -0.018] },
];

const armOf = (side: 1 | -1): readonly Segment[] => [
  { axis: PITCH, to: [0, side * 0.022, 0] },
  { axis: ROLL, to: [0, side * 0.02, -0.052] },
  { axis: ROLL, to: [0, side * 0.004, -0.05] },
  { axis: ROLL, to: [0, 0, -0.02] },
];

/** From the front, so its left is on the right of the flat picture. */
function humanoid(robot: Robot): readonly BodyLink[] {
  const limbs = jointedLimbs(robot).map(({ chain }, index) => {
    const side = (chain[0]?.place.x ?? 0) > 50 ? 1 : -1;
    return isLeg(chain)
      ? limb(robot, chain, `leg_${index}`, [0, side * 0.036, 0], LEG, SOLE)
      : limb(robot, chain, `arm_${index}`, [0, side * 0.058, HUMANOID.shoulder], armOf(side), []);
  });
  return [
    baseLink([
      { shape: 'box', size: [0.05, 0.1, HUMANOID.trunk], at: [0, 0, HUMANOID.trunk / 2] },
      { shape: 'box', size: [0.056, 0.05, 0.05], at: [0, 0, HUMANOID.trunk / 2 + 0.01], kind: 'servo' },
      { shape: 'box', size: [0.044, 0.05, 0.04], at: [0, 0, HUMANOID.trunk + 0.032] },
      { shape: 'cylinder', size: [0.014, 0.016], at: [0, 0, HUMANOID.trunk + 0.006], kind: 'servo' },
    ]),
    ...limbs.flat(),
  ];
}

const SOLE: readonly Part[] = [{ shape: 'box', size: [0.09, 0.05, 0.006], at: [0.008, 0, -0.015] }];

const COXA = 0.028;
const FEMUR = 0.056;
const TIBIA = 0.092;

/** From above, front up: its left is on the left of the flat picture. The shins stand up, as such robots stand. */
function hexapod(robot: Robot): readonly BodyLink[] {
  const limbs = jointedLimbs(robot).map(({ chain }, index) => {
    const root = chain[0]?.place ?? { x: 50, y: 50 };
    const side = root.x < 50 ? 1 : -1;
    const along = (50 - root.y) / 32;
    const leg: readonly Segment[] = [
      { axis: YAW, to: [0, side * COXA, 0] },
      { axis: [1, 0, 0], to: [0, side * FEMUR, 0] },
      { axis: [1, 0, 0], turned: [side * -1.35, 0, 0], to: [0, side * TIBIA, 0] },
    ];
    return limb(
      robot,
      chain,
      `leg_${index}`,
      [along * 0.085, side * (0.062 - Math.abs(along) * 0.012), 0],
      leg,
      [],
    );
  });
  return [
    baseLink([
      { shape: 'box', size: [0.21, 0.1, 0.01], at: [0, 0, 0.02] },
      { shape: 'box', size: [0.21, 0.1, 0.01], at: [0, 0, -0.02] },
      { shape: 'box', size: [0.17, 0.07, 0.034], at: [0, 0, 0], kind: 'servo' },
      { shape: 'box', size: [0.02, 0.05, 0.016], at: [0.1, 0, 0.03] },
    ]),
    ...limbs.flat(),
  ];
}

/** Servos of a limb in a row; one that has more joints than are known continues like the last. */
function limb(
  robot: Robot,
  chain: readonly RobotServo[],
  name: string,
  root: Triple,
  segments: readonly Segment[],
  end: readonly Part[],
): readonly BodyLink[] {
  let on = 'base_link';
  let at = root;
  const parts = chain.flatMap(({ servo }, index) => {
    const segment = segments[Math.min(index, segments.length - 1)];
    if (segment === undefined) return [];
    const child = `${name}_${index}`;
    const isLast = index === chain.length - 1;
    const mount = { on, at, axis: segment.axis, ...(segment.turned && { turned: segment.turned }) };
    const made = turnedLink(robot, servo, child, mount, [
      { shape: 'box', size: [0.024, 0.024, 0.024], kind: 'servo' },
      ...between(segment.to, 0.016),
      ...(isLast ? end : []),
    ]);
    [on, at] = [child, segment.to];
    return [made];
  });
  return [...parts, tip(name, on, at)];
}

const bar = (depth: number, width: number, length: number): Part => ({
  shape: 'box',
  size: [depth, width, length],
  at: [0, 0, length / 2],
});

/** Across the limb, along y. */
const axle = (radius: number, length: number, at: Triple): Part => ({
  shape: 'cylinder',
  size: [radius, length],
  at,
  turned: [QUARTER, 0, 0],
  kind: 'servo',
});

/** A box from the origin to a point that is not straight ahead. */
function between(to: Triple, thickness: number): readonly Part[] {
  const length = Math.hypot(...to);
  if (length < thickness) return [];
  const [x, y, z] = to;
  const middle: Triple = [x / 2, y / 2, z / 2];
  const lean = Math.atan2(-y, z);
  return [
    {
      shape: 'box',
      size: [thickness, thickness, length],
      at: middle,
      turned: [lean, Math.asin(x / length), 0],
    },
  ];
}

const NOT_TURNED = { share: 1, offset: 0 };

function mountOf({ on, at, turned = [0, 0, 0], axis }: Mount, servo: number | null): LinkMount {
  return { on, at, rpy: turned, axis, servo, ...NOT_TURNED };
}

const shapesOf = (parts: readonly Part[]): readonly BodyShape[] =>
  parts.map(({ shape, size, at = [0, 0, 0], turned = [0, 0, 0], kind }) => ({
    ...{ shape, size, at, rpy: turned },
    ...(kind && { kind }),
  }));

const baseLink = (parts: readonly Part[]): BodyLink => ({
  ...{ name: 'base_link', shapes: shapesOf(parts), mount: null, joint: 'none' },
});

/** Stands still where the robot has no such servo. */
function turnedLink(
  robot: Robot,
  number: number | null,
  name: string,
  mount: Mount,
  parts: readonly Part[],
): BodyLink {
  const servo = number === null ? undefined : servoOf(robot, number);
  const shapes = shapesOf(parts);
  if (servo === undefined) return { name, shapes, mount: mountOf(mount, null), joint: 'fixed' };
  return { name, shapes, mount: mountOf(mount, servo.servo), joint: 'servo' };
}

const followingLink = (
  servo: number,
  turn: Pick<LinkMount, 'share' | 'offset'>,
  name: string,
  mount: Mount,
  parts: readonly Part[],
): BodyLink => ({
  ...{ name, shapes: shapesOf(parts), joint: 'follows' },
  mount: { ...mountOf(mount, servo), share: turn.share, offset: turn.offset },
});

const tip = (name: string, on: string, at: Triple): BodyLink => ({
  ...{ name, shapes: [], joint: 'tip' },
  mount: mountOf({ on, at, axis: UP }, null),
});
