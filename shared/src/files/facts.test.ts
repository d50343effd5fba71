import { is } from 'valibot';
import { expect, test } from 'vitest';
import { EMPTY_BOOK, type PoseBook } from '../profile/pose.ts';
import { readyRobot } from '../profile/readyRobots.ts';
import { changeServo } from '../profile/robotEdits.ts';
import { factsSchema, robotFactsOf } from './facts.ts';

const ARM = changeServo(
  readyRobot('arm', 'doc', { robot: 'Arm\ud800', role: (role) => role, limb: (limb) => limb }),
  1,
  { min: 700, max: 2300, trim: 20 },
);
const BOOK: PoseBook = {
  ...EMPTY_BOOK,
  poses: [{ id: 3, name: 'Wave', unit: 'us', targets: [{ servo: 1, position: 1800 }] }],
  nextId: 4,
};

test('limits and poses are as the board counts, home is number 0, and all of it can be sent', () => {
  const facts = robotFactsOf(ARM, BOOK, 7);
  expect(facts).toMatchObject({
    kind: 'robot',
    name: 'Arm\ufffd',
    board: 'doc',
    updatedAtMs: 7,
    lowBatteryMv: 7000,
  });
  expect(facts.limits[0]).toMatchObject({ servo: 1, min: 720, max: 2320 });
  expect(facts.poses.map(({ id, name, targets: [first] }) => [id, name, first?.position])).toEqual([
    [0, 'home', 1520],
    [3, 'Wave', 1820],
  ]);
  expect(is(factsSchema, facts)).toBe(true);
});

test('a pose that a trim takes below nothing is left out', () => {
  const low = { id: 1, name: 'Low', unit: 'steps' as const, targets: [{ servo: 1, position: 10 }] };
  const trimmed = changeServo(ARM, 1, { trim: -100 });
  const { poses } = robotFactsOf(trimmed, { ...BOOK, poses: [low], nextId: 4 }, 7);
  expect(poses.map(({ name }) => name)).toEqual(['home']);
});
