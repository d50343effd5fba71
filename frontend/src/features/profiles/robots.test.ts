import { describe, expect, test } from 'vitest';
import { eventually } from '#shared/testing/eventually.ts';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { READY_ROBOTS, readyRobot, type ReadyRobotId } from '#shared/profile/readyRobots.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { createNotices } from '../../state/notices.ts';
import { createRobots, freshRobot } from './robots.ts';

function storageWith(texts = new Map<string, string>()) {
  return {
    texts,
    getItem: (key: string) => texts.get(key) ?? null,
    setItem: (key: string, text: string) => void texts.set(key, text),
  };
}

function shelf(storage = storageWith()) {
  const notices = createNotices(createVirtualClock());
  const robots = createRobots(storage, notices);
  const noticeTexts = () => notices.store.getState().map(({ text }) => text);
  const names = () => robots.store.getState().present.own.map(({ robot }) => robot.name);
  return { robots, noticeTexts, names, storage };
}

const named =
  (name: string) =>
  (robot: Robot): Robot => ({ ...robot, name });

const narrowed = (robot: Robot): Robot => ({
  ...robot,
  servos: robot.servos.map((servo) => (servo.servo === 4 ? { ...servo, min: 2000, max: 900 } : servo)),
});

describe('robots', () => {
  test('there is one from the start, an arm', () => {
    expect(shelf().robots.current().robot).toMatchObject({ body: 'arm', board: 'doc' });
  });

  test('edits are undone and redone, and are there at the next visit', () => {
    const { robots, storage } = shelf();
    robots.edit(() => 'rename', named('Desk arm'));
    robots.undo();
    robots.redo();
    expect(shelf(storage).robots.current().robot.name).toBe('Desk arm');
  });

  test('an edit that leaves nonsense is refused with its reason, and changes nothing', async () => {
    const { robots, noticeTexts } = shelf();
    const before = robots.current();
    expect(robots.edit(() => 'limits', narrowed)).toBe(false);
    expect(robots.current()).toBe(before);
    await eventually(() =>
      expect(noticeTexts()).toEqual([expect.stringContaining('Elbow (servo 4): its lowest position 2000')]),
    );
  });

  test('a board brings the robot that was described for it, or the usual one', () => {
    const { robots, names } = shelf();
    robots.takeUpFor('lsc-16');
    expect(robots.current().robot.servos).toHaveLength(16);
    robots.edit(() => 'rename', named('Walker'));
    robots.takeUpFor('doc');
    robots.takeUpFor('lsc-16');
    expect(robots.current().robot.name).toBe('Walker');
    expect(names()).toHaveLength(2);
  });

  test('a number is never used twice: what was saved for a removed robot stays its own', () => {
    const { robots, storage } = shelf();
    robots.duplicate();
    const { id } = robots.current();
    robots.remove(id);
    const later = shelf(storage).robots;
    later.duplicate();
    expect(later.current().id).not.toBe(id);
  });

  test('a new one gets a name that tells it from the others', () => {
    const { robots, names } = shelf();
    const arm = robots.current().robot;
    robots.add(() => 'add', arm);
    robots.add(() => 'add', arm);
    robots.duplicate();
    robots.add(() => 'add', { ...arm, name: 'Crane' });
    expect(names()).toEqual(['Arm', 'Arm (2)', 'Arm (3)', 'Arm (3), copy', 'Crane']);
  });

  test('no name says how many servos it has: that may change', () => {
    const ids = Object.keys(READY_ROBOTS) as ReadyRobotId[];
    expect(ids.map((id) => freshRobot(id, 'doc').name).filter((name) => /\d/.test(name))).toEqual([]);
  });

  test('a copy of one with the longest name is there at the next visit, and so are the others', () => {
    const { robots, storage } = shelf();
    robots.edit(() => 'rename', named('a'.repeat(64)));
    robots.duplicate();
    robots.duplicate();
    const { names, noticeTexts } = shelf(storage);
    expect(names()).toEqual(['a'.repeat(64), `${'a'.repeat(60)} (2)`, `${'a'.repeat(60)} (3)`]);
    expect(noticeTexts()).toEqual([]);
  });

  test('duplicates and removals are steps; the last robot stays', () => {
    const { robots, names } = shelf();
    robots.duplicate();
    expect(names()).toEqual(['Arm', 'Arm, copy']);
    robots.remove(robots.current().id);
    robots.remove(robots.current().id);
    expect(names()).toEqual(['Arm']);
    robots.undo();
    expect(names()).toHaveLength(2);
  });

  test.each([
    'x',
    '{}',
    '{"files":[],"currentId":1,"nextId":2}',
    '{"files":[{"id":1,"file":"no"}],"currentId":1,"nextId":2}',
  ])('saved text that is none of ours is set aside: %s', (text) => {
    const storage = storageWith(new Map([['servodeck.robots', text]]));
    const { robots, noticeTexts } = shelf(storage);
    expect(robots.current().robot.body).toBe('arm');
    expect(storage.texts.get('servodeck.robots.unreadable')).toBe(text);
    expect(noticeTexts()).toHaveLength(1);
  });
});

describe('robots that others describe', () => {
  const HAND = readyRobot('hand', 'doc', { robot: 'Hand', role: (role) => role, limb: (limb) => limb });

  test('come and go without a step that could take them back', () => {
    const { robots, names } = shelf();
    const id = robots.takeIn(null, HAND);
    expect(names()).toEqual([expect.any(String), 'Hand']);
    robots.undo();
    expect(names()).toHaveLength(2);
    robots.drop(id);
    robots.undo();
    expect(names()).toHaveLength(1);
  });

  test('are a step where one would undo what was done here', () => {
    const { robots } = shelf();
    robots.edit(() => 'rename', named('Desk arm'));
    robots.takeIn(1, { ...robots.current().robot, name: 'Crane' });
    expect(robots.current().robot.name).toBe('Crane');
    robots.undo();
    expect(robots.current().robot.name).toBe('Desk arm');
  });

  test('never lend their number to the one that stands in where the last is gone', () => {
    const { robots } = shelf();
    robots.add(() => 'add', HAND);
    const hand = robots.current().id;
    robots.drop(1);
    robots.undo();
    expect(robots.current().id).not.toBe(hand);
    expect(robots.current().robot.body).toBe('arm');
  });
});
