// Words about robots: names of the ready ones, of their servos and limbs, and what can be done with a description.

import type { Limb, ReadyRobotId, RobotNames, Role } from '#shared/actions/readyRobots.ts';
import { formatWhole } from './numbers.ts';

const READY: Readonly<Record<ReadyRobotId, string>> = {
  arm: 'Arm, 6 servos',
  hand: 'Hand, 6 servos',
  humanoid16: 'Humanoid, 16 servos',
  humanoid18: 'Humanoid, 18 servos',
  hexapod18: 'Hexapod, 18 servos',
  plain6: 'Plain, 6 servos',
  plain16: 'Plain, 16 servos',
  plain24: 'Plain, 24 servos',
  plain32: 'Plain, 32 servos',
};

const ROLE_NAMES: Readonly<Record<Role, string>> = {
  gripper: 'Gripper',
  wristRoll: 'Wrist roll',
  wrist: 'Wrist',
  elbow: 'Elbow',
  shoulder: 'Shoulder',
  base: 'Base',
  thumb: 'Thumb',
  index: 'Index finger',
  middle: 'Middle finger',
  ring: 'Ring finger',
  little: 'Little finger',
  foot: 'Foot',
  ankle: 'Ankle',
  knee: 'Knee',
  thigh: 'Thigh',
  hip: 'Hip',
  shoulderTurn: 'Shoulder turn',
  upperArm: 'Upper arm',
  hand: 'Hand',
  coxa: 'Coxa',
  femur: 'Femur',
  tibia: 'Tibia',
  servo: 'Servo',
};

const LIMB_NAMES: Readonly<Record<Limb, string>> = {
  leftArm: 'Left arm',
  rightArm: 'Right arm',
  leftLeg: 'Left leg',
  rightLeg: 'Right leg',
  frontLeft: 'Front left leg',
  middleLeft: 'Middle left leg',
  rearLeft: 'Rear left leg',
  frontRight: 'Front right leg',
  middleRight: 'Middle right leg',
  rearRight: 'Rear right leg',
};

export const robotWords = {
  notSaved: 'The browser does not store robots; they are kept until the page is closed.',
  unreadable: 'The saved robots could not be read. They were set aside unharmed.',
  flaw: (flaw: string): string => `This cannot be: ${flaw}.`,
  copyOf: (name: string): string => `${name}, copy`,
  steps: { duplicate: 'duplicate robot', remove: 'remove robot' },
};

export function robotNames(id: ReadyRobotId): RobotNames {
  return {
    robot: READY[id],
    role: (role, servo) =>
      role === 'servo' ? `${ROLE_NAMES.servo} ${formatWhole(servo)}` : ROLE_NAMES[role],
    limb: (limb) => LIMB_NAMES[limb],
  };
}
