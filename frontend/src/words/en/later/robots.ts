// Words about robots: names of the ready ones, of their servos and limbs, and what can be done with a description.

import type { ReadyRobotId } from '#shared/actions/robot/readyRobots.ts';
import type { RobotFileFlaw } from '#shared/actions/robot/robotText.ts';
import { counted, formatWhole } from '../numbers.ts';
import { robotWords, flawText } from '../robots.ts';

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

export const wholeRobotWords = {
  ...robotWords,
  absent: (servo: number): string => `Servo ${formatWhole(servo)}, not on this robot`,
  own: 'Described',
  /** Where they are. */
  place: {
    gateway: 'Kept by the gateway: every screen sees these.',
    browser: 'Kept in this browser.',
  },
  everyones: 'On the board, for everyone',
  count: (servos: number): string => counted(servos, 'servo'),
  atHand: 'In use',
  use: (name: string): string => `Use ${name}`,
  useVerb: 'Use',
  otherBoard: (board: string): string => `Waits for its board, ${board}`,
  calibrate: 'Calibrate',
  edit: 'Edit',
  duplicate: 'Duplicate',
  export: 'Export',
  remove: 'Delete',
  removeNamed: (name: string): string => `Delete ${name}`,
  fresh: 'New robot',
  freshHint: (board: string): string => `Ready ones that fit the ${board}. Add one, then calibrate it.`,
  ready: READY,
  add: (name: string): string => `Add ${name}`,
  import: 'Import a robot file',
  importHint: 'Or drop it here.',
  imported: (name: string): string => `${name} is imported.`,
  importedElsewhere: (name: string, board: string): string =>
    `${name} is imported and waits until its board, ${board}, is connected.`,
  notImported: (file: string, problem: RobotFileFlaw): string =>
    `${file} was not imported: ${flawText(problem)}.`,
  back: 'All robots',
};
