import { expect, test } from 'vitest';
import { readyRobot } from '../profile/readyRobots.ts';
import { frameAngles } from './frames.ts';

const robot = readyRobot('arm', 'doc', { robot: 'Arm', role: (role) => role, limb: (limb) => limb });

test('each frame ends in a pose: servos it leaves out stay where they were, those without a frame at home', () => {
  const frames = [
    { durationMs: 400, targets: [{ servo: 1, position: 2000 }] },
    { durationMs: 600, targets: [{ servo: 2, position: 1000 }] },
  ];
  const [first, second] = frameAngles(frames, robot);
  expect([first?.atMs, second?.atMs]).toEqual([400, 1000]);
  expect(first?.angles.get(1)).toBeCloseTo(Math.PI / 4);
  expect(first?.angles.has(2)).toBe(false);
  expect(second?.angles.get(1)).toBeCloseTo(Math.PI / 4);
  expect(second?.angles.get(2)).toBeCloseTo(-Math.PI / 4);
});

test('servos that the robot does not have turn nothing', () => {
  expect(frameAngles([{ durationMs: 400, targets: [{ servo: 30, position: 2000 }] }], robot)).toEqual([
    { atMs: 400, angles: new Map() },
  ]);
});
