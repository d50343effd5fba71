import { describe, expect, test } from 'vitest';
import { flawOf, type Robot } from '#shared/profile/robot.ts';
import { freshRobot } from './robots.ts';
import { COLUMNS, type ColumnId } from './ServoTable.tsx';

const HUMANOID = freshRobot('humanoid16', 'lsc-32');

function typed(id: ColumnId, text: string, robot: Robot = HUMANOID) {
  const column = COLUMNS.find((one) => one.id === id)!;
  return column.edit(robot, robot.servos[2]!, text);
}

describe('a text typed into a column', () => {
  test('what is shown, typed again, changes nothing', () => {
    for (const column of COLUMNS) {
      const shown = column.show(HUMANOID.servos[2]!);
      expect(typed(column.id, shown)).toEqual({ robot: HUMANOID });
    }
  });

  test.each([
    ['min', '700', { min: 700 }],
    ['home', ' 1400 ', { home: 1400 }],
    ['trim', '-12', { trim: -12 }],
    ['degreesPerUnit', '0,12', { degreesPerUnit: 0.12 }],
    ['name', ' Left knee ', { name: 'Left knee' }],
    ['group', '', { group: '' }],
    ['servo', '20', { servo: 20 }],
  ] as const)('%s: “%s”', (id, text, change) => {
    const edited = typed(id, text);
    expect('robot' in edited && edited.robot.servos[2]).toMatchObject(change);
  });

  test.each([
    ['min', '', '“” is not a whole number.'],
    ['max', '12.5', '“12.5” is not a whole number.'],
    ['servo', 'two', '“two” is not a whole number.'],
    ['degreesPerUnit', '0.1.2', '“0.1.2” is not a number.'],
    ['name', ' ', 'A name needs at least one character.'],
  ] as const)('%s does not take “%s”', (id, text, problem) => {
    expect(typed(id, text)).toEqual({ problem });
  });

  test('a number that another servo has is a flaw of the whole robot', () => {
    const edited = typed('servo', '4');
    expect('robot' in edited && flawOf(edited.robot)).toEqual({ code: 'servoTwice', servo: 4 });
  });
});
