// Words of the calibration: what to do with a servo at each step, and what each button sets.

import type { CalibrationStep } from '#shared/actions/robot/calibration.ts';
import { counted, formatPosition, formatWhole, unitSymbol } from '../numbers.ts';
import type { PositionUnit } from '../../numbers.ts';

/** What holds of a servo, in its board's unit. */
interface Limits {
  readonly min: number;
  readonly home: number;
  readonly max: number;
}

/** What the arrow showed. */
const WAYS = {
  right: 'Did it turn right first, clockwise, as the arrow did?',
  left: 'Did it turn left first, against the clock, as the arrow did?',
};

const HOMEWARD = {
  right: 'Does it turn right, clockwise, as the arrow does?',
  left: 'Does it turn left, against the clock, as the arrow does?',
};

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
    min: 'Hold − or + until it has come to one end of its way. Let go before it hums or touches anything.',
    max: 'Now the other end. Which of the two is the higher figure does not matter.',
    home: 'Bring it to where it rests: straight or level.',
  },
  gripperEnds: {
    min: 'Hold − or + until it is closed. Let go before it hums or pinches anything.',
    max: 'Now wide open. Which of the two is the higher figure does not matter.',
    home: 'Bring it to where it rests: half open.',
  },
  set: {
    min: 'Set lowest here',
    max: 'Set highest here',
    home: 'Set home here',
  },
  keep: (at: number, unit: PositionUnit): string => `Keep ${formatPosition(at, unit)}`,
  keepAndGo: (at: number, unit: PositionUnit): string => `Keep ${formatPosition(at, unit)}, go there slowly`,
  stepLabel: (step: string, servo: string): string => `${step.toLowerCase()} of ${servo}`,
  limitsNow: ({ min, home, max }: Limits, unit: PositionUnit): string =>
    `Lowest ${formatWhole(min)}, home ${formatWhole(home)}, highest ${formatWhole(max)} ${unitSymbol(unit)} now.`,
  homeMoved: (from: number, to: number): string =>
    `Home was ${formatWhole(from)}; between these ends it is ${formatWhole(to)}.`,
  goTo: (at: number, unit: PositionUnit): string => `Go slowly to ${formatPosition(at, unit)}`,
  lower: 'Creep lower',
  higher: 'Creep higher',
  now: 'Commanded position',
  past: (min: number, max: number, unit: PositionUnit): string =>
    `Here it may pass them, up to what the board can do: ${formatWhole(min)} to ${formatWhole(max)} ${unitSymbol(unit)}.`,
  unknown: 'Nobody knows where this servo stands. It first goes to the middle, slowly. Keep clear of it.',
  goHome: 'Go slowly to the middle',
  homeFirst: (at: number, home: number, unit: PositionUnit): string =>
    `The test begins at home, and this servo was sent to ${formatWhole(at)}. First it goes to ${formatPosition(home, unit)}, slowly.`,
  turn: 'Turn a little',
  tooLittleRoom: ({ min, max }: Limits, unit: PositionUnit): string =>
    `Between ${formatWhole(min)} and ${formatPosition(max, unit)} it turns too little to see which way.`,
  setEnds: 'Set its ends anew',
  arrow: 'The way it should turn now',
  sights: {
    gripper: {
      about: 'Watch the gripper and press Turn a little. It moves and comes back.',
      asked: { right: 'Did it close first?', left: 'Did it open first?' },
      homeward: 'It goes home: watch the gripper. Press Turn a little to see more.',
      askedHomeward: { right: 'Does it close?', left: 'Does it open?' },
    },
    side: {
      about:
        'Look at the robot from the side, as in its picture, and press Turn a little. It turns and comes back.',
      asked: WAYS,
      homeward: 'It goes home: look from the side, as in its picture. Press Turn a little to see more.',
      askedHomeward: HOMEWARD,
    },
    above: {
      about: 'Look at the robot from above and press Turn a little. It turns and comes back.',
      asked: WAYS,
      homeward: 'It goes home: look at it from above. Press Turn a little to see more.',
      askedHomeward: HOMEWARD,
    },
    front: {
      about: 'Look at the hand from the front and press Turn a little. It turns and comes back.',
      asked: WAYS,
      homeward: 'It goes home: look at the hand from the front. Press Turn a little to see more.',
      askedHomeward: HOMEWARD,
    },
    horn: {
      about: 'Look at the horn of the servo from outside and press Turn a little. It turns and comes back.',
      asked: WAYS,
      homeward: 'It goes home: look at its horn from outside. Press Turn a little to see more.',
      askedHomeward: HOMEWARD,
    },
  },
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
