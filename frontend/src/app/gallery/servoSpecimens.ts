// The servo panel with each kind of body, and with servos that are selected, locked or calibrated.

import type { Robot } from '#shared/profile/robot.ts';
import type { FamilyId } from '#shared/codec/families.ts';
import { freshRobot } from '../../features/profiles/robots.ts';
import type { ServoView } from '../../features/servoView.ts';
import type { ViewState } from '../../features/view.ts';

/** The longest name: 64 characters. */
export const LONG_NAME = 'The very long name of a thing that a person chose for it.';

export interface ServoSpecimen {
  /** With names in the language in use. */
  robot(): Robot;
  readonly servos?: Partial<ServoView>;
  readonly view?: Partial<ViewState>;
}

/** With limits, another home and a reversed servo. */
function describedArm(): Robot {
  const arm = freshRobot('arm', 'doc');
  return {
    ...arm,
    servos: arm.servos.map((servo) =>
      servo.servo % 2 === 0 ? { ...servo, min: 800, max: 2200, home: 1400, isReversed: true } : servo,
    ),
  };
}

/** Limits at the edges of the board's range, and limits with almost no range between them. */
function shortWays(): Robot {
  const robot = freshRobot('plain6', 'doc');
  const ways = [
    [500, 520],
    [2480, 2500],
    [1500, 1501],
    [500, 501],
    [600, 800],
    [1450, 1550],
  ] as const;
  return {
    ...robot,
    servos: robot.servos.map((servo, index) => {
      const [min, max] = ways[index] ?? [servo.min, servo.max];
      return { ...servo, min, max, home: min };
    }),
  };
}

/** All names have the longest length. */
function longNames(): Robot {
  const robot = freshRobot('humanoid18', 'lsc-24');
  return {
    ...robot,
    name: LONG_NAME,
    servos: robot.servos.map((servo) => ({
      ...servo,
      name: LONG_NAME,
      group: servo.servo > 8 ? LONG_NAME : servo.group,
    })),
  };
}

function oneServo(): Robot {
  const robot = freshRobot('plain6', 'doc');
  return { ...robot, servos: robot.servos.slice(0, 1) };
}

interface Named {
  readonly name: string;
  readonly nickname?: string;
  readonly groupName?: string;
  readonly board?: FamilyId;
  readonly shows?: readonly ['live'];
  readonly robot: ServoSpecimen;
}

const LIVE = { shows: ['live'] } as const;

export const SERVO_SPECIMENS: readonly Named[] = [
  { name: 'One servo', ...LIVE, robot: { robot: oneServo } },
  {
    name: 'Thirty-two servos',
    board: 'lsc-32',
    ...LIVE,
    robot: { robot: () => freshRobot('plain32', 'lsc-32') },
  },
  {
    name: 'Long names',
    board: 'lsc-24',
    nickname: LONG_NAME,
    groupName: LONG_NAME,
    robot: { robot: longNames },
  },
  { name: 'Limits, degrees', ...LIVE, robot: { robot: describedArm, view: { positionsIn: 'degrees' } } },
  { name: 'Limits, short ways', ...LIVE, robot: { robot: shortWays } },
  {
    name: 'Together, weighted',
    ...LIVE,
    robot: {
      robot: describedArm,
      servos: { selected: [3, 4], locked: [6], hidden: [1], together: 'weighted', weights: { 4: -50 } },
    },
  },
  ...(['hand', 'humanoid18', 'hexapod18'] as const).map((id): Named => {
    const board: FamilyId = id === 'hand' ? 'doc' : 'lsc-24';
    return { name: `List of ${id}`, board, ...LIVE, robot: { robot: () => freshRobot(id, board) } };
  }),
  ...(['arm', 'hand', 'humanoid18', 'hexapod18', 'plain16'] as const).map((id): Named => {
    const board: FamilyId = id === 'arm' || id === 'hand' ? 'doc' : 'lsc-24';
    return {
      name: `Body of ${id}`,
      board,
      ...LIVE,
      robot: { robot: () => freshRobot(id, board), servos: { selected: [3] }, view: { servoLayout: 'body' } },
    };
  }),
];
