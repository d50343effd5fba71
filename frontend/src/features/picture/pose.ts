// From positions to angles of an arm's joints and of a dial's needle. Pure geometry. No board reports the real angle (trim, direction),
// so the middle of the range is drawn as straight.

import type { RobotServo } from '#shared/profile/robot.ts';
import type { Family, Range } from '#shared/codec/families.ts';

/** The servos of a limb, in the order of the robot. */
export interface Limb {
  /** Empty for servos without a limb. */
  readonly group: string;
  readonly servos: readonly RobotServo[];
}

export function limbsOf(servos: readonly RobotServo[]): readonly Limb[] {
  const groups = [...new Set(servos.map(({ group }) => group))];
  return groups.map((group) => ({ group, servos: servos.filter((servo) => servo.group === group) }));
}

/** The position of a servo; null if unknown. */
export type Pose = (servo: number) => number | null;

/** Joints of the usual six-servo arm (boards.md section 9). */
export const JOINT = { gripper: 1, roll: 2, wrist: 3, elbow: 4, shoulder: 5, base: 6 } as const;

/** Turn of the output shaft over the whole range, in degrees: PWM servos half a turn, bus servos two thirds. */
const TURN_DEGREES = { us: 180, steps: 240 } as const;
/** A dial is open at the bottom, like a gauge. */
const DIAL_DEGREES = 240;
const JAW_OPEN_DEGREES = 42;
const JAW_SHUT_DEGREES = 3;
const SAME_DEGREES = 0.5;

type Scale = Pick<Family, 'unit' | 'position' | 'centre'>;

export interface ArmPicture {
  readonly shoulder: Link;
  readonly elbow: Link;
  readonly wrist: Link;
  readonly base: Link;
  readonly roll: Link;
  /** Half the angle between the jaws seen from the side, foreshortened by the roll. */
  readonly jaw: Link;
  /** Half the angle seen from the front. */
  readonly jawFront: Link;
}

interface Link {
  readonly degrees: number;
  /** False if the position of this joint, or of one that carries it, is unknown. */
  readonly known: boolean;
}

export function armPicture(pose: Pose, scale: Scale): ArmPicture {
  const joint = (servo: number, carriedBy: boolean): Link => {
    const position = pose(servo);
    return { degrees: shaftDegrees(position ?? scale.centre, scale), known: carriedBy && position !== null };
  };
  const shoulder = joint(JOINT.shoulder, true);
  const elbow = joint(JOINT.elbow, shoulder.known);
  const wrist = joint(JOINT.wrist, elbow.known);
  const roll = joint(JOINT.roll, true);
  const grip = pose(JOINT.gripper);
  const jawDegrees =
    JAW_OPEN_DEGREES - fraction(grip ?? scale.centre, scale.position) * (JAW_OPEN_DEGREES - JAW_SHUT_DEGREES);
  const seen = Math.abs(Math.cos((roll.degrees * Math.PI) / 180));
  return {
    shoulder,
    elbow,
    wrist,
    base: joint(JOINT.base, true),
    roll,
    jaw: {
      degrees: Math.max(JAW_SHUT_DEGREES, jawDegrees * seen),
      known: wrist.known && roll.known && grip !== null,
    },
    jawFront: { degrees: jawDegrees, known: roll.known && grip !== null },
  };
}

/** True if two pictures differ too little to be seen; then the outline of the target is hidden. */
export function samePicture(one: ArmPicture, other: ArmPicture): boolean {
  return (['shoulder', 'elbow', 'wrist', 'jaw'] as const).every(
    (link) => Math.abs(one[link].degrees - other[link].degrees) < SAME_DEGREES,
  );
}

/** The angle of the shaft from the centre. */
export function shaftDegrees(position: number, { unit, position: range, centre }: Scale): number {
  return ((position - centre) / (range.max - range.min)) * TURN_DEGREES[unit];
}

/** The angle of a dial's needle from straight up. */
export function dialDegrees(position: number, scale: Scale): number {
  return (fraction(position, scale.position) - 0.5) * DIAL_DEGREES;
}

/** A sixth of a pixel at the needle's tip: finer angles are invisible. */
export const halfDegree = (degrees: number): number => Math.round(degrees * 2) / 2;

/** 0 at the low end of the range, 1 at the high end. */
export function fraction(position: number, { min, max }: Range): number {
  return (position - min) / (max - min);
}

/** Positions by servo. */
type PoseShown = ReadonlyMap<number, number>;

export function samePose(one: PoseShown, other: PoseShown): boolean {
  if (one === other) return true;
  return one.size === other.size && [...one].every(([servo, position]) => other.get(servo) === position);
}

interface Look {
  readonly pose: PoseShown;
  readonly changed: readonly number[];
}

export function sameLook(one: Look, other: Look): boolean {
  return samePose(one.pose, other.pose) && one.changed.join() === other.changed.join();
}
