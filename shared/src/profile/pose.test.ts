// Poses as values: shapes keep their promises for any pose of any robot, edits keep the book whole, files come back.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { evenly } from '../testing/cases.ts';
import type { ServoTarget } from '../codec/commands.ts';
import {
  EMPTY_BOOK,
  flawOfBook,
  type PoseBook,
  addPose,
  duplicatePose,
  markApplied,
  markRest,
  movePose,
  removePose,
  renamePose,
  setPose,
  withPosesOf,
  poseBookFromText,
  poseBookToText,
} from './pose.ts';
import { blended, flippedTargets, homeTargets, mirroredTargets, sameTargets } from './poseShapes.ts';
import { readyRobot, type RobotNames } from './readyRobots.ts';
import { refusedTarget } from './robot.ts';

const NAMES: RobotNames = { robot: 'Mine', role: (role, servo) => `${role} ${servo}`, limb: (limb) => limb };
const HUMANOID = readyRobot('humanoid16', 'lsc-16', NAMES);
const HEXAPOD = readyRobot('hexapod18', 'lsc-24', NAMES);
const ARM = readyRobot('arm', 'openarm-new', NAMES);

const targetsOf = (servos: number, range = { min: 500, max: 2500 }) =>
  fc.uniqueArray(fc.record({ servo: fc.integer({ min: 1, max: servos }), position: fc.integer(range) }), {
    selector: ({ servo }) => servo,
    minLength: 1,
  });

describe.each([
  ['humanoid', HUMANOID],
  ['hexapod', HEXAPOD],
  ['arm', ARM],
])('shapes of the %s', (_, robot) => {
  const anyTargets = targetsOf(robot.servos.length);

  test('mirrored or flipped twice, a pose is itself', () => {
    fc.assert(
      fc.property(anyTargets, (targets) => {
        for (const shape of [mirroredTargets, flippedTargets]) {
          const { targets: there, held } = shape(robot, targets);
          expect(held).toEqual([]);
          expect(sameTargets(shape(robot, there).targets, targets)).toBe(true);
        }
      }),
    );
  });

  test('home is its own mirror and flip, and within the limits', () => {
    const home = homeTargets(robot);
    expect(mirroredTargets(robot, home)).toEqual({ targets: home, held: [] });
    expect(flippedTargets(robot, home)).toEqual({ targets: home, held: [] });
    expect(refusedTarget(robot, home)).toBeNull();
  });
});

describe('mirror and flip', () => {
  const narrow = {
    ...HUMANOID,
    servos: HUMANOID.servos.map((servo) => (servo.servo === 9 ? { ...servo, min: 1300, max: 1700 } : servo)),
  };

  test("a mirrored left leg is the right one's; a servo in the middle stays", () => {
    expect(mirroredTargets(HUMANOID, [{ servo: 3, position: 1800 }]).targets).toEqual([
      { servo: 11, position: 1800 },
    ]);
    expect(mirroredTargets(ARM, [{ servo: 6, position: 900 }]).targets).toEqual([
      { servo: 6, position: 900 },
    ]);
  });

  test('a flipped servo turns as far the other way', () => {
    expect(flippedTargets(ARM, [{ servo: 6, position: 900 }]).targets).toEqual([
      { servo: 6, position: 2100 },
    ]);
  });

  test('never leaves the limits, and names the servo that a limit held', () => {
    fc.assert(
      fc.property(targetsOf(16), (targets) => {
        for (const shape of [mirroredTargets, flippedTargets]) {
          const { targets: there, held } = shape(narrow, targets);
          expect(refusedTarget(narrow, there)?.servo.servo).not.toBe(9);
          for (const servo of held) expect(servo.servo).toBe(9);
        }
      }),
    );
    const { targets, held } = mirroredTargets(narrow, [{ servo: 1, position: 2000 }]);
    expect(targets).toEqual([{ servo: 9, position: 1700 }]);
    expect(held.map(({ name }) => name)).toEqual(['foot 9']);
  });
});

describe('a blend', () => {
  test('is one pose at its start, the other at its end, and between them everywhere else', () => {
    fc.assert(
      fc.property(targetsOf(8), targetsOf(8), evenly(0, 1), (one, other, share) => {
        const has = (list: readonly ServoTarget[], servo: number) => list.some((t) => t.servo === servo);
        const common = (list: readonly ServoTarget[]) =>
          list.filter(({ servo }) => has(one, servo) && has(other, servo));
        expect(sameTargets(blended(one, other, 0), common(one))).toBe(true);
        expect(sameTargets(blended(one, other, 1), common(other))).toBe(true);
        for (const { servo, position } of blended(one, other, share)) {
          const ends = [...one, ...other].filter((t) => t.servo === servo).map((t) => t.position);
          expect(position).toBeGreaterThanOrEqual(Math.min(...ends));
          expect(position).toBeLessThanOrEqual(Math.max(...ends));
        }
      }),
    );
  });
});

const at = (position: number) => ({ unit: 'us' as const, targets: [{ servo: 1, position }] });
const named = (book: PoseBook): readonly string[] => book.poses.map(({ name }) => name);
const three = ['Wave', 'Bow', 'Sit'].reduce<PoseBook>(
  (book, name, index) => addPose(book, { name, ...at(1000 + index) }),
  EMPTY_BOOK,
);

describe('edits of the book', () => {
  test('add, copy, move, rename and remove', () => {
    expect(named(three)).toEqual(['Wave', 'Bow', 'Sit']);
    expect(named(duplicatePose(three, 1, 'Wave 2'))).toEqual(['Wave', 'Wave 2', 'Bow', 'Sit']);
    expect(named(duplicatePose(three, 1, 'a'.repeat(70)))[1]).toBe('a'.repeat(64));
    expect(named(movePose(three, 1, 2))).toEqual(['Bow', 'Sit', 'Wave']);
    expect(named(renamePose(three, 2, 'Nod'))).toEqual(['Wave', 'Nod', 'Sit']);
    expect(named(removePose(three, 2))).toEqual(['Wave', 'Sit']);
  });

  test('what changes nothing is the very same book', () => {
    expect(movePose(three, 1, 0)).toBe(three);
    expect(movePose(three, 3, 99)).toBe(three);
    expect(renamePose(three, 1, 'Wave')).toBe(three);
    expect(setPose(three, 1, [{ servo: 1, position: 1000 }])).toBe(three);
    expect(setPose(three, 1, [])).toBe(three);
    expect(removePose(three, 9)).toBe(three);
    expect(markApplied(markApplied(three, 'home'), 'home').applied).toBe('home');
  });

  test('a removed pose is neither the rest nor the applied one any more, and its number is not used again', () => {
    const marked = markApplied(markRest(three, 3), 3);
    const removed = removePose(marked, 3);
    expect(removed).toMatchObject({ restId: null, applied: null });
    expect(addPose(removed, { name: 'New', ...at(1) }).poses.at(-1)?.id).toBe(4);
  });

  test('poses of a file come behind ours under numbers of our own', () => {
    const both = withPosesOf(markRest(three, 1), three);
    expect(both.poses.map(({ id }) => id)).toEqual([1, 2, 3, 4, 5, 6]);
    expect(both.restId).toBe(1);
  });
});

test('where the robot went last is no pose that was changed, or marked as rest, since', () => {
  const at = (position: number) => [{ servo: 1, position }];
  const one = addPose(EMPTY_BOOK, { name: 'Folded', unit: 'us', targets: at(1200) });
  const book = addPose(one, { name: 'Tall', unit: 'us', targets: at(1800) });
  const gone = markApplied(book, 1);
  expect(setPose(gone, 1, at(1300)).applied).toBeNull();
  expect(setPose(gone, 1, at(1200)).applied).toBe(1);
  expect(setPose(gone, 2, at(1300)).applied).toBe(1);
  const rested = markApplied(markRest(book, 1), 'rest');
  expect(setPose(rested, 1, at(1300)).applied).toBeNull();
  expect(markRest(rested, 2).applied).toBe(1);
  expect(markRest(markApplied(book, 'rest'), 2).applied).toBe('home');
});

describe('a book as text', () => {
  const books = fc
    .array(fc.record({ name: fc.stringMatching(/^[a-zäß]{1,20}$/u), targets: targetsOf(32) }), {
      maxLength: 6,
    })
    .map((poses) =>
      poses.reduce<PoseBook>((book, pose) => addPose(book, { ...pose, unit: 'steps' }), EMPTY_BOOK),
    );

  test('is read back as it was', () => {
    fc.assert(
      fc.property(books, (book) => {
        const marked = markApplied(markRest(book, book.poses.at(0)?.id ?? null), 'rest');
        expect(flawOfBook(marked)).toBeNull();
        expect(poseBookFromText(poseBookToText(marked))).toEqual({ value: marked });
      }),
    );
  });

  test.each([
    ['{', 'notOurs', ''],
    [poseBookToText(three).replace('"version": 1', '"version": 2'), 'otherVersion', ''],
    [poseBookToText({ ...three, restId: 9 }), 'poseMissing', ''],
    [poseBookToText({ ...three, nextId: 2 }), 'sameNumber', ''],
    [poseBookToText(renamePose(three, 1, ' ')), 'badValue', 'content.poses.0.name'],
    [
      poseBookToText({
        ...three,
        poses: [{ ...three.poses[0]!, targets: [...at(1).targets, ...at(2).targets] }],
      }),
      'servoTwice',
      'Wave',
    ],
  ])('one that is damaged says where', (text, code, at) => {
    expect(poseBookFromText(text)).toEqual({ problem: { code, at } });
  });
});
