// Words of the description of a robot: what each figure of a servo is called, and why one is not taken.

import { formatWhole, unitSymbol } from '../numbers.ts';
import type { PositionUnit } from '../../numbers.ts';

export const robotEditorWords = {
  name: 'Name of the robot',
  board: (name: string): string => `For ${name}`,
  body: 'Drawn as',
  bodies: { arm: 'Arm', hand: 'Hand', humanoid: 'Humanoid', hexapod: 'Hexapod', plain: 'Plain, dials only' },
  battery: 'Fed by',
  batteries: { adapter: 'Mains adapter or USB', '2s': 'Battery, 2 cells', '3s': 'Battery, 3 cells' },
  servos: 'Servos of the robot',
  columns: {
    servo: 'No.',
    name: 'Name',
    group: 'Group',
    min: 'Lowest',
    home: 'Home',
    max: 'Highest',
    trim: 'Trim',
    degreesPerUnit: 'Degrees per unit',
  },
  degrees: (unit: PositionUnit): string => `° per ${unit === 'us' ? unitSymbol(unit) : 'step'}`,
  reversed: 'Reversed',
  mirror: 'Mirror',
  noMirror: 'None',
  cell: (column: string, servo: string): string => `${column} of ${servo}`,
  row: (servo: number, name: string): string => `Servo ${formatWhole(servo)}, ${name}`,
  step: (column: string, servo: string): string => `${column} of ${servo}`,
  add: 'Add servo',
  addStep: 'add servo',
  full: 'The board takes no more servos.',
  remove: (name: string): string => `Remove ${name}`,
  removeStep: (name: string): string => `remove ${name}`,
  newServo: (servo: number): string => `Servo ${formatWhole(servo)}`,
  notNumber: (text: string): string => `“${text}” is no number.`,
  notWhole: (text: string): string => `“${text}” is no whole number.`,
  noName: 'A name has at least one letter.',
  reach: (min: number, max: number, unit: PositionUnit): string =>
    `The board turns it from ${formatWhole(min)} to ${formatWhole(max)} ${unitSymbol(unit)}`,
  places: 'Places on the body',
  placesHint:
    'Drag each servo to where it sits on your robot, or push it with the arrow keys. Nothing moves.',
  hint: 'Enter goes on in the row below. What cannot be is not taken, and the field says why.',
};
