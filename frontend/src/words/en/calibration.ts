// Words of the calibration: what to do with a servo at each step, and what each button sets.

import type { CalibrationStep } from '#shared/actions/robot/robotCalibration.ts';
import { counted, formatPosition, formatWhole, unitSymbol } from './numbers.ts';
import type { PositionUnit } from '../numbers.ts';

export const calibrationWords = {
  servos: 'Servos to calibrate',
  servo: (name: string, done: number, all: number): string =>
    `${name}, ${formatWhole(done)} of ${counted(all, 'step')} done`,
  steps: 'Steps of this servo',
  stepNames: {
    min: 'Lowest',
    max: 'Highest',
    home: 'Home',
    direction: 'Direction',
    partner: 'Mirror',
    trim: 'Trim',
  } satisfies Record<CalibrationStep, string>,
  isDone: (step: string): string => `${step}, done`,
  ends: {
    min: 'Hold − or + until it is as low as it may go. Let go before it hums or touches anything.',
    max: 'Now the other end: as high as it may go.',
    home: 'Bring it to where it rests: straight, level or half open.',
  },
  set: {
    min: 'Set lowest here',
    max: 'Set highest here',
    home: 'Set home here',
  },
  keep: (at: number, unit: PositionUnit): string => `Keep ${formatPosition(at, unit)}`,
  stepLabel: (step: string, servo: string): string => `${step.toLowerCase()} of ${servo}`,
  lower: 'Creep lower',
  higher: 'Creep higher',
  now: 'Commanded position',
  past: (min: number, max: number, unit: PositionUnit): string =>
    `May pass the present limits here, never what the board can do: ${formatWhole(min)} to ${formatWhole(max)} ${unitSymbol(unit)}.`,
  unknown: 'Nobody knows where this servo stands. It first goes to the middle, slowly. Keep clear of it.',
  goHome: 'Go slowly to the middle',
  direction: 'Press Turn a little and watch. It turns and comes back.',
  turn: 'Turn a little',
  arrow: 'Which way it should turn, as the picture of the robot shows it',
  asked: 'Did it turn the way of the arrow?',
  same: 'Yes, that way',
  other: 'No, the other way',
  partner: (name: string): string =>
    `${name} is its mirror. It can take over the mirror image of what was set:`,
  partnerFigures: (min: number, home: number, max: number): string =>
    `Lowest ${formatWhole(min)}, home ${formatWhole(home)}, highest ${formatWhole(max)}`,
  partnerNot: 'Its board does not turn that far. Calibrate the partner by itself.',
  takeOver: (name: string): string => `Set ${name} so`,
  allHome: (count: number): string => `All ${formatWhole(count)} go home, one after another`,
  keepServo: (name: string): string => `Leave all of ${name} as it is`,
  onToPoses: 'Go on to poses',
  leaveAsIs: 'Leave it as it is',
  trim: (home: number, centre: number, trim: number): string =>
    `Home stands at ${formatWhole(home)}. With a trim of ${formatWhole(trim)} it is called ${formatWhole(centre)}, so that poses fit other robots of this build. Nothing moves.`,
  trimNone: 'Home is the middle of what the board can do. No trim is needed.',
  trimFar: (home: number, centre: number, reach: number): string =>
    `Home stands at ${formatWhole(home)}; a trim goes ${formatWhole(reach)} to either side of ${formatWhole(centre)}, farther than half a tooth of the horn. To mend it, seat the horn one tooth further. Poses work all the same.`,
  trimSet: (centre: number): string => `Call it ${formatWhole(centre)}`,
  goOn: 'Go on',
  finished: 'Every servo is calibrated.',
  done: 'Done',
  stopped: 'Stopped. Nothing moves until you resume.',
};
