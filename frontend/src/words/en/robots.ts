// Words about robots: names of the ready ones, of their servos and limbs, and what can be done with a description.

import type { Limb, ReadyRobotId, RobotNames, Role } from '#shared/actions/robot/readyRobots.ts';
import type { RobotFlaw, ServoFlaw } from '#shared/actions/robot/robot.ts';
import type { RobotFileFlaw } from '#shared/actions/robot/robotText.ts';
import type { Range } from '#shared/protocol/families.ts';
import type { LibraryErrorCode } from '#shared/actions/library/keeper.ts';
import { libraryWords } from './library.ts';
import { formatNames, formatWhole } from './numbers.ts';
import { FIELD_TAKES, inList } from './robotFields.ts';

/** What it is called once it is a robot: its servos may become more or fewer. */
const NAMES: Readonly<Record<ReadyRobotId, string>> = {
  ...{ arm: 'Arm', hand: 'Hand', hexapod18: 'Hexapod' },
  ...{ humanoid16: 'Humanoid', humanoid18: 'Humanoid' },
  ...{ plain6: 'Plain', plain16: 'Plain', plain24: 'Plain', plain32: 'Plain' },
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

export function flawText(flaw: RobotFileFlaw): string {
  switch (flaw.code) {
    case 'notOurs':
      return 'this is no robot file of Servodeck';
    case 'otherVersion':
      return 'another version of Servodeck has written it';
    case 'field':
      return `${inList(flaw.of)}“${flaw.field}” takes ${FIELD_TAKES[flaw.field]}`;
    case 'strangeField':
      return `${inList(flaw.of)}there is no “${flaw.field}”`;
    case 'servoTwice':
      return `servo ${formatWhole(flaw.servo)} is there twice`;
    case 'alarmNotBelow':
      return `its battery alarm ${formatWhole(flaw.alarmMv)} mV is not below its warning ${formatWhole(flaw.warnMv)} mV`;
    case 'servo':
      return `${flaw.servo.name} (servo ${formatWhole(flaw.servo.servo)}): ${servoFlawText(flaw.flaw)}`;
  }
}

export function servoFlawText(flaw: ServoFlaw): string {
  switch (flaw.code) {
    case 'number':
      return `its board takes servos ${rangeText(flaw.range)}`;
    case 'minNotBelowMax':
      return `its lowest position ${formatWhole(flaw.min)} is not below its highest ${formatWhole(flaw.max)}`;
    case 'home':
    case 'trim':
      return `its ${flaw.code} ${formatWhole(flaw.value)} is outside ${rangeText(flaw.range)}`;
    case 'beyondBoard':
      return `with its trim it leaves what the board can do, ${rangeText(flaw.range)}`;
    case 'noMirror':
      return `its mirror, servo ${formatWhole(flaw.mirror)}, is not there`;
  }
}

export const rangeText = ({ min, max }: Range): string => `${formatWhole(min)}..${formatWhole(max)}`;

export const robotWords = {
  notSaved: 'The browser does not store robots; they are kept until the page is closed.',
  unreadable: 'The saved robots could not be read. They were set aside unharmed.',
  flaw: (flaw: RobotFlaw): string => `This cannot be: ${flawText(flaw)}.`,
  notKept: (code: LibraryErrorCode, detail: string): string =>
    code === 'tooLarge'
      ? 'A robot with its poses and buttons is too large for the library. It stays in this browser alone; delete some poses.'
      : `Robots are not kept in the library yet: ${libraryWords.problem(code, detail)} It is tried again.`,
  otherVersion: (name: string): string => `${name}, other version`,
  conflict: (name: string, copy: string): string =>
    `Somebody else has changed ${name} meanwhile. Yours is kept beside it as ${copy}.`,
  handedIn: (names: readonly string[]): string =>
    `The gateway keeps robots now, for every screen. Those of this browser stand beside the others: ${formatNames(names)}.`,
  onlyLooking: 'Viewers see the robot as others describe it; they change nothing.',
  othersHands: (driver: string): string =>
    `${driver} drives: which robot it is and its limits change only under the hands of whoever drives.`,
  copyOf: (name: string): string => `${name}, copy`,
  numbered: (name: string, number: number): string => `${name} (${formatWhole(number)})`,
  steps: {
    duplicate: 'duplicate robot',
    remove: 'remove robot',
    add: 'new robot',
    import: 'import robot',
    elsewhere: 'change on another screen',
  },
  /** Both knees of a body are called Knee. */
  called: ({ name, group }: { readonly name: string; readonly group: string }): string =>
    group === '' ? name : `${name} (${group})`,
  title: 'Robots',
  button: (name: string): string => `Robot: ${name}`,
  /** What a ready robot is called when it is added. */
  names: robotNames,
};

function robotNames(id: ReadyRobotId): RobotNames {
  return {
    robot: NAMES[id],
    role: (role, servo) =>
      role === 'servo' ? `${ROLE_NAMES.servo} ${formatWhole(servo)}` : ROLE_NAMES[role],
    limb: (limb) => LIMB_NAMES[limb],
  };
}
