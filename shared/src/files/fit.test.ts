import { describe, expect, test } from 'vitest';
import { FAMILIES } from '../codec/families.ts';
import { emptyGroup, type ActionGroup } from '../group/group.ts';
import { insertFrame } from '../group/groupEdits.ts';
import { readyRobot } from '../profile/readyRobots.ts';
import { misfitsOf } from './fit.ts';
import { inUnit, meaningIn, onlyFittingUnit } from './reading.ts';

const family = FAMILIES['openarm-new'];
const ready = readyRobot('arm', 'openarm-new', {
  robot: 'Arm',
  role: (role) => role,
  limb: (limb) => limb,
});
const robot = {
  ...ready,
  servos: ready.servos.map((servo) => (servo.servo === 2 ? { ...servo, min: 900, max: 2100 } : servo)),
};

const groupOf = (...positions: readonly Readonly<Record<number, number>>[]): ActionGroup =>
  positions.reduce<ActionGroup>(
    (group, pose, index) =>
      insertFrame(group, index, {
        durationMs: 500,
        targets: Object.entries(pose).map(([servo, position]) => ({ servo: Number(servo), position })),
      }),
    emptyGroup('Wave', 'us'),
  );

const misfits = (group: ActionGroup) => misfitsOf(group, family, robot);

describe('what does not fit a board is listed', () => {
  test('nothing of what fits to the edge', () => {
    const group = groupOf({ 1: 500, 2: 900 }, { 1: 2500, 2: 2100, 6: 1500 });
    expect(misfits({ ...group, slot: 255 })).toEqual([]);
  });

  test('positions by servo, from the smallest to the largest, within what the robot may do', () => {
    expect(misfits(groupOf({ 1: 499, 2: 899 }, { 2: 2100 }, { 2: 2101 }))).toEqual([
      { code: 'position', servo: 1, frames: [1], values: { min: 499, max: 499 }, allowed: family.position },
      {
        ...{ code: 'position', servo: 2, frames: [1, 3] },
        ...{ values: { min: 899, max: 2101 }, allowed: { min: 900, max: 2100 } },
      },
    ]);
  });

  test('servos it has not, too many of them, times, frames and slots', () => {
    const long = groupOf(...Array<Record<number, number>>(256).fill({ 1: 1500 }));
    const codes = (group: ActionGroup) => misfits(group).map(({ code, frames }) => [code, ...frames]);
    expect(codes(groupOf({ 0: 1500, 6: 1500, 7: 1500 }))).toEqual([
      ['servo', 1],
      ['servo', 1],
    ]);
    expect(codes(groupOf({ 1: 1, 2: 2, 3: 3, 4: 4, 5: 5, 6: 6, 7: 7 }))[0]).toEqual(['servoCount', 1]);
    expect(codes(insertFrame(groupOf({}), 1, { durationMs: 30_001, targets: [] }))).toEqual([
      ['duration', 2],
    ]);
    expect(misfits(long)).toMatchObject([
      { code: 'frameCount', values: { max: 256 }, allowed: { max: 255 } },
    ]);
    expect(misfitsOf({ ...groupOf({}), slot: 255 }, FAMILIES['learm-esp32'], robot)).toMatchObject([
      { code: 'slot', values: { min: 255 } },
    ]);
  });

  test('another unit, of which no position can be judged', () => {
    expect(misfits({ ...groupOf({ 1: 10, 9: 10 }), unit: 'steps' }).map(({ code }) => code)).toEqual([
      'unit',
      'servo',
    ]);
  });
});

describe('units', () => {
  const group = groupOf({ 1: 400, 2: 1000 }, { 1: 1200 });

  test('a group says what its numbers would mean in either', () => {
    expect(meaningIn('us', group)).toEqual({ positions: { min: 400, max: 1200 }, outside: 1 });
    expect(meaningIn('steps', group)).toEqual({ positions: { min: 400, max: 1200 }, outside: 1 });
    expect(meaningIn('us', groupOf({}))).toEqual({ positions: null, outside: 0 });
  });

  test('where the numbers fit one unit alone, it is that one; else a person has to say', () => {
    expect(onlyFittingUnit(groupOf({ 1: 1500 }))).toBe('us');
    expect(onlyFittingUnit(groupOf({ 1: 0, 2: 1000 }))).toBe('steps');
    expect(onlyFittingUnit(groupOf({ 1: 500, 2: 1000 }))).toBeNull();
    expect(onlyFittingUnit(group)).toBeNull();
  });

  test('naming the unit changes no number', () => {
    expect(inUnit(group, 'steps')).toEqual({ ...group, unit: 'steps' });
    expect(inUnit(group, 'us')).toBe(group);
  });
});
