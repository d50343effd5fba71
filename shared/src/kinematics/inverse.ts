// Which angles bring the tip of a chain to a place (inverse kinematics): damped least squares within the joints' limits. Damping grows
// where a step made it worse and shrinks where it helped (Levenberg and Marquardt). Out of reach it stops at the nearest place.
// Metres and radians. Knows no servos and no time.

import {
  type Chain,
  type ChainJoint,
  type ChainPose,
  cross,
  dot,
  lengthOf,
  minus,
  poseOfChain,
  scaled,
  type Vec3,
} from './model.ts';

export interface Wish {
  readonly tip: Vec3;
  /** Sine of the angle of `pointing` above the horizontal, 0 for level; null where any will do. */
  readonly rise: number | null;
}

export interface Solution {
  readonly angles: readonly number[];
  /** How far the tip stays away from where it was wished, in metres. */
  readonly missM: number;
}

/**
 * A joint that is led by a hand turns at most so many times as far as one that swings the whole limb along with it. Near a singular
 * place, where a millimetre takes tens of degrees, the tip lags behind instead (measured in ADR 62).
 */
const MOST_TURN = 6;
const ITERATIONS = 60;
/** Good enough to stop: a tenth of what the servos can resolve. */
const ENOUGH_M = 5e-5;
/** What a rise of 1 counts beside the metres of the tip: about the length of a hand. */
export const RISE_M = 0.1;
/** So far in one iteration, where the Jacobian still means something. */
const STEP_M = 0.05;
const DAMPING = { first: 1e-3, least: 1e-7, most: 10, shrinks: 0.3, grows: 4 };
/** Other starts, before the nearest place is what it can do. */
const STARTS = 16;
const PRIMES = [2, 3, 5, 7, 11, 13];
/** Reached as well as another, if it comes as near as this. */
const SAME_M = 5e-4;

/**
 * For a drag: the nearest way from the angles given, for a hand that has moved by `askedM` since. No joint turns farther than that asks,
 * and the elbow keeps its side; where it cannot go on, it stays.
 */
export function follow(chain: Chain, from: readonly number[], wish: Wish, askedM: number): Solution {
  return descend(withinReachOfHand(chain, from, askedM), from, wish);
}

/** The limits of the joints, narrowed to what one movement of the hand may do. */
function withinReachOfHand(chain: Chain, from: readonly number[], askedM: number): Chain {
  const most = (MOST_TURN * askedM) / limbLengthM(chain);
  const bend = bendOf(poseOfChain(chain, from));
  const joints = chain.joints.map((joint, index) => {
    const at = clamped(from[index] ?? 0, joint);
    const { min, max } = index === ELBOW ? onItsSide(joint, at, bend) : joint;
    return { ...joint, min: Math.max(min, at - most), max: Math.min(max, at + most) };
  });
  return { ...chain, joints };
}

/** From the second joint to the tip: the first one may sit far out on a body. */
const limbLengthM = ({ joints, tip }: Chain): number =>
  joints.slice(1).reduce((sum, { origin }) => sum + lengthOf(origin), lengthOf(tip));

/** An elbow that is bent stays so: from straight, either side is as near. */
function onItsSide({ min, max }: ChainJoint, at: number, bend: number): Pick<ChainJoint, 'min' | 'max'> {
  if (Math.abs(bend) < STRAIGHT) return { min, max };
  const straightest = at - bend + Math.sign(bend) * Math.min(Math.abs(bend), STILL_BENT);
  return bend > 0 ? { min: Math.max(min, straightest), max } : { min, max: Math.min(max, straightest) };
}

/** For a place typed in: tries other elbows and the other side of the base where the nearest way does not end there. */
export function reach(chain: Chain, from: readonly number[], wish: Wish): Solution {
  let best = descend(chain, from, wish);
  for (let start = 1; start <= STARTS && best.cost > SAME_M; start++) {
    const other = descend(chain, startOf(chain, start), wish);
    if (other.cost < best.cost) best = other;
  }
  return best;
}

/**
 * The place where the tip is, with the elbow bent the other way; null where its limits do not allow that. The pointing stays,
 * where it can.
 */
export function flip(chain: Chain, from: readonly number[], rise: Wish['rise']): Solution | null {
  const pose = poseOfChain(chain, from);
  const side = sideOf(pose);
  if (side === 0) return null;
  for (const wanted of new Set([rise ?? pose.pointing[2], rise])) {
    const wish: Wish = { tip: pose.tip, rise: wanted };
    const starts = Array.from({ length: STARTS }, (_, start) => startOf(chain, start + 1));
    const found = [mirrored(chain, from), ...starts]
      .map((start) => descend(chain, start, wish))
      .filter(({ angles, cost }) => cost <= SAME_M && sideOf(poseOfChain(chain, angles)) === -side)
      .sort((one, other) => turnOf(from, one.angles) - turnOf(from, other.angles));
    if (found[0] !== undefined) return found[0];
  }
  return null;
}

/** Which way the third joint bends, from the joint before it to the next one: 1, -1, or 0 for straight. */
function sideOf(pose: ChainPose): number {
  const bend = bendOf(pose);
  return Math.abs(Math.sin(bend)) < STRAIGHT ? 0 : Math.sign(bend);
}

/** The angle of the third joint from straight, about its axis; 0 where the limb has no elbow. */
function bendOf({ joints, tip }: ChainPose): number {
  const [before, elbow] = [joints[ELBOW - 1], joints[ELBOW]];
  if (before === undefined || elbow === undefined) return 0;
  const next = joints.slice(ELBOW + 1).find(({ at }) => lengthOf(minus(at, elbow.at)) > SAME_M);
  const { at, axis } = elbow;
  const across = (vector: Vec3): Vec3 => minus(vector, scaled(axis, dot(vector, axis)));
  const [near, far] = [across(minus(at, before.at)), across(minus(next?.at ?? tip, at))];
  if (Math.min(lengthOf(near), lengthOf(far)) < SAME_M) return 0;
  return Math.atan2(dot(cross(near, far), axis), dot(near, far));
}

/** A degree. */
const STRAIGHT = 0.0175;
/** Two degrees: with the rounding to whole units of a servo it still counts as bent. */
const STILL_BENT = 2 * STRAIGHT;
/** Base, shoulder, elbow. */
const ELBOW = 2;

const mirrored = ({ joints }: Chain, from: readonly number[]): readonly number[] =>
  joints.map((joint, index) => clamped((index < ELBOW ? 1 : -1) * (from[index] ?? 0), joint));

const turnOf = (from: readonly number[], to: readonly number[]): number =>
  to.reduce((most, angle, index) => Math.max(most, Math.abs(angle - (from[index] ?? 0))), 0);

type Found = Solution & { readonly cost: number };

/** Evenly over what the joints can do: each joint its own irrational step, as in a Weyl sequence. */
const startOf = ({ joints }: Chain, start: number): readonly number[] =>
  joints.map(
    ({ min, max }, index) =>
      min + (max - min) * ((start * Math.sqrt(PRIMES[index % PRIMES.length] ?? 2)) % 1),
  );

function descend(chain: Chain, from: readonly number[], wish: Wish): Found {
  let angles = chain.joints.map((joint, index) => clamped(from[index] ?? 0, joint));
  let pose = poseOfChain(chain, angles);
  let cost = costOf(pose, wish);
  let damping = DAMPING.first;
  for (let iteration = 0; iteration < ITERATIONS && cost > ENOUGH_M && damping < DAMPING.most; iteration++) {
    const tried = stepped(chain, angles, pose, wish, damping);
    const triedPose = poseOfChain(chain, tried);
    const triedCost = costOf(triedPose, wish);
    if (triedCost < cost) {
      [angles, pose, cost] = [tried, triedPose, triedCost];
      damping = Math.max(DAMPING.least, damping * DAMPING.shrinks);
    } else damping *= DAMPING.grows;
  }
  return { angles, cost, missM: lengthOf(minus(wish.tip, pose.tip)) };
}

/** Joints that would leave their limits stay there, and the others take the step again without them. */
function stepped(
  { joints }: Chain,
  angles: readonly number[],
  pose: ChainPose,
  wish: Wish,
  damping: number,
): number[] {
  const error = errorOf(pose, wish);
  const columns = pose.joints.map(({ at, axis }) => columnOf(at, axis, pose, wish));
  const free = new Set(joints.keys());
  for (;;) {
    const solved = dampedStep(columns, free, error, damping);
    const blocked = [...free].filter((index) => {
      const [joint, angle, step] = [joints[index], angles[index] ?? 0, solved[index] ?? 0];
      return joint !== undefined && ((angle >= joint.max && step > 0) || (angle <= joint.min && step < 0));
    });
    if (blocked.length === 0)
      return joints.map((joint, index) => clamped((angles[index] ?? 0) + (solved[index] ?? 0), joint));
    for (const index of blocked) free.delete(index);
  }
}

/** How the tip (and the rise) change for each radian of one joint. */
function columnOf(at: Vec3, axis: Vec3, { tip, pointing }: ChainPose, { rise }: Wish): readonly number[] {
  const moved = cross(axis, minus(tip, at));
  return rise === null ? moved : [...moved, cross(axis, pointing)[2] * RISE_M];
}

function errorOf({ tip, pointing }: ChainPose, wish: Wish): readonly number[] {
  const whole = minus(wish.tip, tip);
  const far = lengthOf(whole);
  const part = far > STEP_M ? scaled(whole, STEP_M / far) : whole;
  return wish.rise === null ? part : [...part, (wish.rise - pointing[2]) * RISE_M];
}

const costOf = ({ tip, pointing }: ChainPose, wish: Wish): number =>
  Math.hypot(lengthOf(minus(wish.tip, tip)), wish.rise === null ? 0 : (wish.rise - pointing[2]) * RISE_M);

/** Jᵀ (J Jᵀ + damping² I)⁻¹ error, over the joints that are free; 0 for the others. */
function dampedStep(
  columns: readonly (readonly number[])[],
  free: ReadonlySet<number>,
  error: readonly number[],
  damping: number,
): readonly number[] {
  const rows = error.map((wanted, row) => [
    ...error.map((_, other) => {
      const start = row === other ? damping ** 2 : 0;
      return columns.reduce(
        (sum, column, joint) => (free.has(joint) ? sum + (column[row] ?? 0) * (column[other] ?? 0) : sum),
        start,
      );
    }),
    wanted,
  ]);
  const weights = eliminated(rows);
  return columns.map((column, joint) =>
    free.has(joint) ? weights.reduce((sum, weight, row) => sum + weight * (column[row] ?? 0), 0) : 0,
  );
}

/** Gauss and Jordan. Each row ends with its right side; the damping on the diagonal keeps the pivots above 0. */
function eliminated(rows: number[][]): readonly number[] {
  for (const [pivot, row] of rows.entries()) {
    const by = row[pivot] ?? 1;
    for (let column = pivot; column < row.length; column++) row[column] = (row[column] ?? 0) / by;
    for (const other of rows) {
      const factor = other[pivot] ?? 0;
      if (other === row || factor === 0) continue;
      for (let column = pivot; column < row.length; column++)
        other[column] = (other[column] ?? 0) - factor * (row[column] ?? 0);
    }
  }
  return rows.map((row) => row.at(-1) ?? 0);
}

const clamped = (angle: number, { min, max }: { readonly min: number; readonly max: number }): number =>
  Math.min(max, Math.max(min, angle));
