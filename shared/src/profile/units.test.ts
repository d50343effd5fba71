import fc from 'fast-check';
import { expect, test } from 'vitest';
import { FAMILIES, type FamilyId } from '../codec/families.ts';
import { someGroup } from '../testing/groups.ts';
import { convertGroup } from '../group/frameEdits.ts';
import { familyOfUnit, robotInUnit } from './units.ts';
import { flawOf } from './robot.ts';
import { readyRobot, usualRobot, type RobotNames } from './readyRobots.ts';

const NAMES: RobotNames = { robot: 'Mine', role: (role, servo) => `${role} ${servo}`, limb: (limb) => limb };

const inSteps = someGroup({ positions: fc.integer({ min: 0, max: 1000 }) }).map((group) => ({
  ...group,
  unit: 'steps' as const,
}));

test('steps become pulse widths and are the same steps again; pulse widths come back within one µs', () => {
  fc.assert(
    fc.property(inSteps, (group) => {
      expect(convertGroup(convertGroup(group, 'us')!, 'steps')).toEqual(group);
    }),
  );
  fc.assert(
    fc.property(someGroup(), (group) => {
      const back = convertGroup(convertGroup(group, 'steps')!, 'us')!;
      expect({ ...back, frames: [] }).toEqual({ ...group, frames: [] });
      back.frames.forEach(({ targets, ...frame }, index) => {
        const { targets: before, ...rest } = group.frames[index]!;
        expect(frame).toEqual(rest);
        expect(targets.map(({ servo }) => servo)).toEqual(before.map(({ servo }) => servo));
        targets.forEach(({ position }, at) =>
          expect(Math.abs(position - before[at]!.position)).toBeLessThanOrEqual(1),
        );
      });
    }),
  );
});

test('as the vendors rescale it; what is beyond a servo stays beyond it, what cannot be written down is not converted', () => {
  const group = (...positions: readonly number[]) => ({
    ...{ name: 'Wave', robot: '', tags: [], slot: 7, times: 2, markers: [], nextId: 2, maxErrorUnits: 20 },
    unit: 'us' as const,
    frames: [
      {
        ...{ id: 1, durationMs: 400, easing: 'linear' as const, note: '', colour: null },
        targets: positions.map((position, index) => ({ servo: index + 1, position })),
      },
    ],
  });
  const steps = convertGroup(group(500, 1501, 2500, 2900), 'steps');
  expect(steps?.frames[0]?.targets.map(({ position }) => position)).toEqual([0, 501, 1000, 1200]);
  expect(steps).toMatchObject({ unit: 'steps', slot: 7, maxErrorUnits: 10 });
  expect(convertGroup(group(400), 'steps')).toBeNull();
  const same = group(700);
  expect(convertGroup(same, 'us')).toBe(same);
});

test('a robot in the other unit is one that could be, with its servos where they were', () => {
  for (const board of Object.keys(FAMILIES) as FamilyId[]) {
    const robot = readyRobot(usualRobot(board), board, NAMES);
    const { unit } = FAMILIES[board];
    const other = robotInUnit(robot, unit === 'us' ? 'steps' : 'us');
    expect(flawOf(other)).toBeNull();
    expect(other.servos.map(({ servo, name }) => [servo, name])).toEqual(
      robot.servos.map(({ servo, name }) => [servo, name]),
    );
    expect(robotInUnit(robot, unit)).toBe(robot);
    expect(familyOfUnit(unit).unit).toBe(unit);
  }
});
