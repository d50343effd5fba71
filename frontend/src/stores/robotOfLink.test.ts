import { describe, expect, test } from 'vitest';
import { limitsOnBoard, type NamedLimits, type Robot } from '#shared/actions/robot/robot.ts';
import { withLimits } from '#shared/actions/robot/robotEdits.ts';
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

const ELBOW = { servo: 4, name: 'Elbow', min: 1000, max: 2000 };

const trimmed = (robot: Robot): Robot => ({
  ...robot,
  servos: robot.servos.map((servo) => ({ ...servo, min: 700, max: 2300, trim: 20 })),
});

function follower() {
  const storage = { getItem: () => null, setItem: () => undefined };
  const robots = createRobots(storage, createNotices(createVirtualClock()));
  const told: Robot[] = [];
  const held: (readonly NamedLimits[])[] = [];
  const note = followRobot(robots, {
    tell: (robot) => told.push(robot),
    heldOtherwise: (limits) => held.push(limits),
  });
  return { robots, told, held, note };
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

  test('leaves limits standing that others had said before, until it is changed here', () => {
    const { robots, told, held, note } = follower();
    note({ ...ready('doc'), limitsHeld: [ELBOW] });
    expect(told).toEqual([]);
    expect(held).toEqual([[ELBOW]]);
    robots.edit(
      () => 'limits',
      (robot) => withLimits(robot, [ELBOW]),
    );
    expect(limitsOnBoard(told[0]!).find(({ servo }) => servo === 4)).toEqual(ELBOW);
  });

  test('hears what others say while it is ready, and is silent about what it has itself', () => {
    const { told, held, note } = follower();
    note(ready('doc'));
    note({ ...ready('doc'), limitsHeld: limitsOnBoard(told[0]!) });
    expect(held).toEqual([]);
    const heard = { ...ready('doc'), limitsHeld: [ELBOW] };
    note(heard);
    note({ ...heard, latch: null });
    expect(held).toEqual([[ELBOW]]);
    expect(told).toHaveLength(1);
  });

  test('is told where it was changed while the link was away, whatever others said meanwhile', () => {
    const { robots, told, held, note } = follower();
    note(ready('doc'));
    note({ ...ready('doc'), link: { status: 'opening' } });
    robots.edit(() => 'limits', trimmed);
    note({ ...ready('doc'), limitsHeld: [ELBOW] });
    expect(held).toEqual([]);
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
