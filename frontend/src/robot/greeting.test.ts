import { expect, test } from 'vitest';
import { refusedTarget } from '#shared/profile/robot.ts';
import { changeServo } from '#shared/profile/robotEdits.ts';
import { freshRobot } from '../features/profiles/robots.ts';
import { greetingOf } from './connector.ts';

test('the arm rises within the limits that were set', () => {
  const narrow = changeServo(freshRobot('arm', 'doc'), 1, { min: 500, max: 520, home: 510 });
  const robot = changeServo(narrow, 5, { min: 2480, max: 2500, home: 2490 });
  expect(greetingOf(robot).map(({ position }) => position)).toEqual([520, 1500, 1950, 2050, 2480, 1500]);
  expect(refusedTarget(robot, greetingOf(robot))).toBeNull();
});

test('servos beyond the arm stay, and missing ones are not spoken to', () => {
  const robot = freshRobot('plain16', 'doc');
  const few = { ...robot, servos: robot.servos.slice(4) };
  expect(greetingOf(few).map(({ servo }) => servo)).toEqual([5, 6]);
});
