// Robots ready to use, as their owners have them (boards.md section 9). Names come from the caller, in the person's language:
// here a servo only has a role and a limb. Knows bodies, no session.

import { FAMILIES, positionRange, type Family, type FamilyId } from '../codec/families.ts';
import type { BatteryKind, BodyKind, Robot, RobotServo } from './robot.ts';

export const ROLES = [
  ...(['gripper', 'wristRoll', 'wrist', 'elbow', 'shoulder', 'base'] as const),
  ...(['thumb', 'index', 'middle', 'ring', 'little'] as const),
  ...(['foot', 'ankle', 'knee', 'thigh', 'hip', 'shoulderTurn', 'upperArm', 'hand'] as const),
  ...(['coxa', 'femur', 'tibia', 'servo'] as const),
] as const;
export type Role = (typeof ROLES)[number];

export const LIMBS = [
  ...(['leftArm', 'rightArm', 'leftLeg', 'rightLeg'] as const),
  ...(['frontLeft', 'middleLeft', 'rearLeft', 'frontRight', 'middleRight', 'rearRight'] as const),
] as const;
export type Limb = (typeof LIMBS)[number];

interface Joint {
  readonly role: Role;
  readonly limb?: Limb;
  /** The partner's number. */
  readonly mirror?: number;
  /** On the body's picture, percent. */
  readonly at: readonly [x: number, y: number];
}

export interface RobotNames {
  readonly robot: string;
  role(role: Role, servo: number): string;
  limb(limb: Limb): string;
}

/** Base, shoulder, elbow and so on up to the gripper; servo 1 is the gripper. In a row below the arm, which moves about. */
const ARM: readonly Joint[] = (['gripper', 'wristRoll', 'wrist', 'elbow', 'shoulder', 'base'] as const).map(
  (role, index) => ({ role, at: [Math.round(9 + index * 16.4), 84] }),
);

const HAND: readonly Joint[] = (
  [
    ['thumb', 14, 52],
    ['index', 34, 14],
    ['middle', 50, 8],
    ['ring', 66, 14],
    ['little', 82, 26],
    ['base', 50, 90],
  ] as const
).map(([role, x, y]) => ({ role, at: [x, y] }));

/** From the foot up, then the arm; the right side has the same eight numbers on. */
const HUMANOID_SIDE: readonly (readonly [role: Role, limb: 'Leg' | 'Arm', x: number, y: number])[] = [
  ['foot', 'Leg', 14, 92],
  ['ankle', 'Leg', 14, 80],
  ['knee', 'Leg', 14, 68],
  ['thigh', 'Leg', 14, 56],
  ['hip', 'Leg', 8, 46],
  ['elbow', 'Arm', 38, 34],
  ['upperArm', 'Arm', 32, 22],
  ['shoulderTurn', 'Arm', 20, 14],
];
const SIDE_SERVOS = HUMANOID_SIDE.length;

function humanoid(hasHands: boolean): readonly Joint[] {
  const side = (name: 'left' | 'right', offset: number): readonly Joint[] =>
    HUMANOID_SIDE.map(([role, limb, x, y], index) => ({
      role,
      limb: `${name}${limb}`,
      mirror: ((index + offset + SIDE_SERVOS) % (2 * SIDE_SERVOS)) + 1,
      at: [name === 'left' ? 50 + x : 50 - x, y],
    }));
  const hands: readonly Joint[] = [
    { role: 'hand', limb: 'leftArm', mirror: 18, at: [94, 44] },
    { role: 'hand', limb: 'rightArm', mirror: 17, at: [6, 44] },
  ];
  return [...side('left', 0), ...side('right', SIDE_SERVOS), ...(hasHands ? hands : [])];
}

/** Three servos a leg, left legs first, from the front; seen from above. */
const LEGS = ['frontLeft', 'middleLeft', 'rearLeft', 'frontRight', 'middleRight', 'rearRight'] as const;
const LEG_ROLES = ['coxa', 'femur', 'tibia'] as const;

const HEXAPOD: readonly Joint[] = LEGS.flatMap((limb, leg) =>
  LEG_ROLES.map((role, joint): Joint => {
    const reach = 12 + joint * 15;
    return {
      role,
      limb,
      mirror: ((leg + 3) % LEGS.length) * 3 + joint + 1,
      at: [leg < 3 ? 50 - reach : 50 + reach, 18 + (leg % 3) * 32],
    };
  }),
);

/** Rows of at most eight, for a body without a description. */
function plain(count: number): readonly Joint[] {
  const columns = Math.min(8, count);
  const rows = Math.ceil(count / columns);
  const middle = (index: number, of: number): number => Math.round(((index + 0.5) / of) * 100);
  return Array.from({ length: count }, (_, index) => ({
    role: 'servo' as const,
    at: [middle(index % columns, columns), middle(Math.floor(index / columns), rows)] as const,
  }));
}

interface ReadyRobot {
  readonly body: BodyKind;
  readonly joints: readonly Joint[];
  readonly battery: BatteryKind;
  /** Boards such robots are built on, the usual one first. */
  readonly boards: readonly FamilyId[];
}

const SMALL_BOARDS = [
  'openarm-new',
  'openarm-old',
  'learm-esp32',
  'learm-esp32-bus',
  'xarm',
  'bus-ctrl',
  'lsc-6',
  'doc',
] as const;
const MANY = ['lsc-32', 'lsc-24', 'bus-ctrl', 'doc'] as const;

export const READY_ROBOTS = {
  arm: { body: 'arm', joints: ARM, battery: 'adapter', boards: SMALL_BOARDS },
  hand: { body: 'hand', joints: HAND, battery: 'adapter', boards: SMALL_BOARDS },
  humanoid16: {
    body: 'humanoid',
    joints: humanoid(false),
    battery: '2s',
    boards: ['lsc-16', 'lsc-24', 'lsc-32', 'bus-ctrl', 'doc'],
  },
  humanoid18: {
    body: 'humanoid',
    joints: humanoid(true),
    battery: '3s',
    boards: ['lsc-24', 'lsc-32', 'bus-ctrl', 'doc'],
  },
  hexapod18: {
    body: 'hexapod',
    joints: HEXAPOD,
    battery: '2s',
    boards: ['lsc-24', 'lsc-32', 'bus-ctrl', 'doc'],
  },
  plain6: {
    body: 'plain',
    joints: plain(6),
    battery: 'adapter',
    boards: [...SMALL_BOARDS, ...MANY, 'lsc-16'],
  },
  plain16: { body: 'plain', joints: plain(16), battery: '2s', boards: ['lsc-16', ...MANY] },
  plain24: { body: 'plain', joints: plain(24), battery: '2s', boards: MANY },
  plain32: { body: 'plain', joints: plain(32), battery: '2s', boards: ['lsc-32', 'bus-ctrl', 'doc'] },
} as const satisfies Readonly<Record<string, ReadyRobot>>;

export type ReadyRobotId = keyof typeof READY_ROBOTS;

/** Half a turn over the range of a common PWM servo, 240 degrees over that of a bus servo (X9). */
export const DEGREES_PER_UNIT = { us: 0.09, steps: 0.24 } as const;

export function readyRobot(id: ReadyRobotId, board: FamilyId, names: RobotNames): Robot {
  const { body, joints, battery }: ReadyRobot = READY_ROBOTS[id];
  const family = FAMILIES[board];
  return {
    name: names.robot,
    ...{ board, body, battery },
    batteryCare: { policy: 'tell', thresholds: null },
    servos: joints.map((joint, index) => servoFor(joint, index + 1, family, names)),
  };
}

function servoFor(
  { role, limb, mirror, at: [x, y] }: Joint,
  servo: number,
  family: Family,
  names: RobotNames,
): RobotServo {
  const { min, max } = positionRange(family, servo);
  return {
    servo,
    name: names.role(role, servo),
    group: limb === undefined ? '' : names.limb(limb),
    ...{ min, max },
    home: Math.min(max, Math.max(min, family.centre)),
    isReversed: false,
    trim: 0,
    degreesPerUnit: DEGREES_PER_UNIT[family.unit],
    mirror: mirror ?? null,
    place: { x, y },
  };
}

/** The robot of a board until a person describes it: with as many servos as such boards usually move. */
export function usualRobot(board: FamilyId): ReadyRobotId {
  const { usualServoCount } = FAMILIES[board];
  if (usualServoCount === 6) return 'arm';
  return usualServoCount === 16 ? 'plain16' : usualServoCount === 24 ? 'plain24' : 'plain32';
}
