// How far a body by bones reaches in any pose within its limits, so that the scale of its picture never changes. Pure geometry in percent
// of the picture.

import { degreesOf, servoOf, type Robot, type RobotServo } from '#shared/profile/robot.ts';
import {
  bonesOf,
  handBase,
  jointedLimbs,
  lastBone,
  rootOf,
  type BonePicture,
  type Limb,
  type Point,
} from './bones.ts';

export interface Reach {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

const SQUARE: Reach = { left: 0, top: 0, right: 100, bottom: 100 };
/** Half of a bone's thickness with its outline. */
const THICKNESS = 3;
/** The samples between a servo's limits. */
const LOOKS = Array.from({ length: 17 }, (_, look) => look / 16);

const known = new WeakMap<Robot, Reach>();

/** null for bodies that are not drawn by bones. */
export function reachOf(robot: Robot): Reach | null {
  const home = bonesOf(robot, () => null);
  if (home === null) return null;
  const before = known.get(robot);
  if (before !== undefined) return before;
  const reach = outgrown(robot.body === 'hand' ? handReach(robot) : limbsReach(robot));
  known.set(robot, reach);
  return reach;
}

/** The square of the places, enlarged for this pose: for a picture that does not move. */
export const roomFor = ({ bones }: BonePicture): Reach =>
  including(SQUARE, outgrown(around(bones.map(({ to }) => to))));

/** As the `viewBox` of an SVG. */
export const viewBoxOf = ({ left, top, right, bottom }: Reach): string =>
  `${left} ${top} ${right - left} ${bottom - top}`;

/** For each turn of the base, with each finger straight or folded. */
function handReach(robot: Robot): Reach {
  const base = handBase(robot.servos);
  const poses = LOOKS.flatMap((look) =>
    [0, 1].map((fold) => (servo: number) => {
      const own = servoOf(robot, servo);
      return own === undefined ? null : between(own, own === base ? look : fold);
    }),
  );
  return poses
    .flatMap((pose) => bonesOf(robot, pose) ?? [])
    .map(({ trunk, bones }) => around([...trunk, ...bones.flatMap(({ from, to }) => [from, to])]))
    .reduce(including);
}

/** Sums the largest extent of each bone: consecutive joints can nearly always point in the same direction. */
function limbsReach(robot: Robot): Reach {
  const limbs = jointedLimbs(robot).map((limb) => ({
    root: pointReach(rootOf(limb.chain)),
    ends: endsOf(limb),
  }));
  const all = limbs.flatMap(({ root, ends }) => [root, ...ends]).reduce(including);
  if (robot.body !== 'humanoid') return all;
  // The body stands on its lowest bone, so the picture shifts by the height of that bone in a pose.
  const ground = Math.max(...(bonesOf(robot, () => null)?.bones ?? []).map(({ to }) => to.y));
  const ends = limbs.flatMap((limb) => limb.ends);
  const rises = Math.max(0, Math.max(...ends.map(({ bottom }) => bottom)) - ground);
  const sinks = Math.max(0, ground - Math.max(...ends.map(({ top }) => top)));
  const lowestRoot = Math.max(...limbs.map(({ root }) => root.bottom));
  return { ...all, top: all.top - rises, bottom: Math.max(ground, lowestRoot + sinks) };
}

function endsOf(limb: Limb): readonly Reach[] {
  let from = pointReach(rootOf(limb.chain));
  return limb.chain.map((_, index) => {
    const joints = limb.chain.slice(0, index + 1);
    const bones = LOOKS.flatMap((first) =>
      LOOKS.map((others) =>
        lastBone(
          limb,
          joints.map((servo, joint) => degreesOf(servo, between(servo, joint === 0 ? first : others))),
        ),
      ),
    );
    from = summed(from, around(bones));
    return from;
  });
}

const between = ({ min, max }: RobotServo, share: number): number => min + (max - min) * share;

const pointReach = ({ x, y }: Point): Reach => ({ left: x, top: y, right: x, bottom: y });

const around = (points: readonly Point[]): Reach => points.map(pointReach).reduce(including);

const including = (one: Reach, other: Reach): Reach => ({
  left: Math.min(one.left, other.left),
  top: Math.min(one.top, other.top),
  right: Math.max(one.right, other.right),
  bottom: Math.max(one.bottom, other.bottom),
});

const summed = (one: Reach, other: Reach): Reach => ({
  left: one.left + other.left,
  top: one.top + other.top,
  right: one.right + other.right,
  bottom: one.bottom + other.bottom,
});

const outgrown = ({ left, top, right, bottom }: Reach): Reach => ({
  left: left - THICKNESS,
  top: top - THICKNESS,
  right: right + THICKNESS,
  bottom: bottom + THICKNESS,
});
