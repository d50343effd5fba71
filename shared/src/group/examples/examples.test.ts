import { describe, expect, test } from 'vitest';
import { FAMILIES, type FamilyId } from '../../codec/families.ts';
import { compile } from '../compile.ts';
import { flawOfGroup, totalDurationMs } from '../group.ts';
import { READY_ROBOTS, readyRobot, type ReadyRobotId } from '../../profile/readyRobots.ts';
import { refusedTarget, type Robot } from '../../profile/robot.ts';
import { exampleGroup, examplesFor } from './examples.ts';

const names = { robot: 'Robot', role: (role: string) => role, limb: (limb: string) => limb };

const robots = (Object.keys(READY_ROBOTS) as ReadyRobotId[]).flatMap((id) =>
  READY_ROBOTS[id].boards.map((board: FamilyId) => ({ id, board, robot: readyRobot(id, board, names) })),
);

/** Its own limits, its home off the middle, some servos the other way round. */
function awkward(robot: Robot): Robot {
  return {
    ...robot,
    servos: robot.servos.map((servo) => {
      const quarter = Math.round((servo.max - servo.min) / 4);
      return {
        ...servo,
        min: servo.min + quarter,
        home: servo.min + quarter + 10,
        isReversed: servo.servo % 2 === 0,
      };
    }),
  };
}

describe.each(robots)('examples for $id on $board', ({ board, robot }) => {
  const groups = (of: Robot) => examplesFor(of).map((id) => exampleGroup(id, of, id));

  test('are a handful, each a few seconds long and a whole group', () => {
    expect(groups(robot).length).toBeGreaterThanOrEqual(2);
    for (const group of groups(robot)) {
      expect(flawOfGroup(group)).toBeNull();
      expect(totalDurationMs(group.frames)).toBeGreaterThan(2500);
      expect(totalDurationMs(group.frames)).toBeLessThan(20_000);
      expect(group.unit).toBe(FAMILIES[board].unit);
    }
  });

  test('keep the limits of the robot, whatever they are', () => {
    for (const one of [robot, awkward(robot)]) {
      for (const { frames } of groups(one))
        for (const { targets } of frames) expect(refusedTarget(one, targets)).toBeNull();
    }
  });

  test('fit the board, and its servos can follow', () => {
    for (const group of groups(robot)) {
      const { report } = compile(group, {
        family: FAMILIES[board],
        robot,
        maxErrorUnits: FAMILIES[board].unit === 'us' ? 5 : 2,
      });
      expect(report.problems.filter(({ kind }) => kind !== 'tooManyServos')).toEqual([]);
    }
  });

  test('move something, and end without a jump of it', () => {
    for (const { frames } of groups(robot)) {
      const places = new Set(frames.map(({ targets }) => JSON.stringify(targets)));
      expect(places.size).toBeGreaterThan(1);
    }
  });
});
