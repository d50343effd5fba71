import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { mirror } from './frameEdits.ts';
import { someGroup } from '../testing/groups.ts';
import { readyRobot, type RobotNames } from '../profile/readyRobots.ts';

const NAMES: RobotNames = { robot: 'Mine', role: (role, servo) => `${role} ${servo}`, limb: (limb) => limb };
const HUMANOID = readyRobot('humanoid16', 'lsc-16', NAMES);

describe('left and right', () => {
  test('mirrored twice is as it was, and only these frames are mirrored', () => {
    const humanoid = someGroup({
      servos: HUMANOID.servos.map(({ servo }) => servo),
      positions: fc.integer({ min: 1400, max: 1600 }),
    });
    fc.assert(
      fc.property(humanoid, (group) => {
        const ids = group.frames.slice(1).map(({ id }) => id);
        const { group: there, held } = mirror(group, HUMANOID, ids);
        expect(held).toEqual([]);
        expect(there.frames[0]).toBe(group.frames[0]);
        expect(mirror(there, HUMANOID, ids).group).toEqual(group);
      }),
    );
  });
});
