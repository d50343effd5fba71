import { expect, test } from 'vitest';
import { family } from '../protocol/families.ts';
import { createVirtualClock } from '../simulator/virtualClock.ts';
import { createRobotEstimate } from './robot.ts';

test('a released servo is unknown again: it drops (X7)', async () => {
  const clock = createVirtualClock();
  const robot = createRobotEstimate(family('xarm'), clock);
  robot.applied({ kind: 'move', durationMs: 1_500, targets: [{ servo: 1, position: 500 }] });
  await clock.advance(2_000);
  expect(robot.motion(1)).toEqual({ target: 500, estimated: 500 });
  robot.applied({ kind: 'release', servos: [1] });
  expect(robot.motion(1)).toEqual({ target: null, estimated: null });
});
