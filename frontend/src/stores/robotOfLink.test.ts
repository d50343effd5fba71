import { describe, expect, test } from 'vitest';
import { limitsOnBoard, type Robot } from '#shared/actions/robot/robot.ts';
import { FAMILIES, type FamilyId } from '#shared/protocol/families.ts';
import { INITIAL_STATE } from '#shared/session/store.ts';
import type { SessionState } from '#shared/session/state.ts';
import { createVirtualClock } from '#shared/simulator/virtualClock.ts';
import { createNotices } from './notices.ts';
import { followRobot } from './robotOfLink.ts';
import { createRobots } from './robots.ts';

const ready = (board: FamilyId): SessionState => ({
  ...INITIAL_STATE,
  family: FAMILIES[board],
  link: { status: 'ready' },
});

const trimmed = (robot: Robot): Robot => ({
  ...robot,
  servos: robot.servos.map((servo) => ({ ...servo, min: 700, max: 2300, trim: 20 })),
});

function follower() {
  const storage = { getItem: () => null, setItem: () => undefined };
  const robots = createRobots(storage, createNotices(createVirtualClock()));
  const told: Robot[] = [];
  const note = followRobot(robots, (robot) => told.push(robot));
  return { robots, told, note };
}

describe('the robot of a link', () => {
  test('is told once the link is ready, once, and whenever it changes', () => {
    const { robots, told, note } = follower();
    robots.edit(() => 'limits', trimmed);
    expect(told).toEqual([]);
    note(ready('doc'));
    note(ready('doc'));
    expect(told).toHaveLength(1);
    robots.undo();
    expect(told).toHaveLength(2);
    expect(limitsOnBoard(told[0]!)[0]).toEqual({ servo: 1, name: 'Gripper', min: 720, max: 2320 });
  });

  test('is told again after the link was away', () => {
    const { told, note } = follower();
    note(ready('doc'));
    note({ ...ready('doc'), link: { status: 'opening' } });
    note(ready('doc'));
    expect(told).toHaveLength(2);
  });

  test('is always one of the connected board, whatever is undone, removed or chosen', () => {
    const { robots, told, note } = follower();
    const arm = robots.current();
    note(ready('lsc-16'));
    expect(robots.current().robot.board).toBe('lsc-16');
    robots.takeUp(arm.id);
    expect(robots.current().robot.board).toBe('lsc-16');
    robots.remove(robots.current().id);
    expect(robots.current().robot.board).toBe('lsc-16');
    expect(told.map(({ board }) => board)).not.toContain('doc');
  });
});
