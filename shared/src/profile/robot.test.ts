// Robots as data: the ready ones are sound on each of their boards, files come back as they went, limits and trims hold.

import { toJsonSchema } from '@valibot/to-json-schema';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import publishedFile from '../../../docs/robot.schema.json' with { type: 'json' };
import { READY_ROBOTS, readyRobot, type ReadyRobotId, type RobotNames } from './readyRobots.ts';
import {
  degreesOf,
  flawOf,
  fromBoard,
  mirrored,
  onBoard,
  positionOf,
  refusedTarget,
  servoOf,
  type Robot,
  type ServoFlaw,
} from './robot.ts';
import { robotFileSchema, robotFromText, robotToText } from './robotText.ts';

const NAMES: RobotNames = { robot: 'Mine', role: (role, servo) => `${role} ${servo}`, limb: (limb) => limb };
const READY = Object.entries(READY_ROBOTS).flatMap(([id, { boards }]) =>
  boards.map((board) => [id as ReadyRobotId, board] as const),
);
const ARM = readyRobot('arm', 'openarm-new', NAMES);

const withServo = (change: Partial<Robot['servos'][number]>): Robot => ({
  ...ARM,
  servos: ARM.servos.map((servo) => (servo.servo === 4 ? { ...servo, name: 'Elbow', ...change } : servo)),
});

describe.each(READY)('the ready %s on %s', (id, board) => {
  const robot = readyRobot(id, board, NAMES);

  test('is sound, comes back from its file, and has a place for each servo', () => {
    expect(flawOf(robot)).toBeNull();
    expect(robotFromText(robotToText(robot))).toEqual({ robot });
    const places = robot.servos.map(({ place }) => `${place.x} ${place.y}`);
    expect(new Set(places).size).toBe(places.length);
  });

  test("a servo's mirror has it as its own mirror", () => {
    const partnered = robot.servos.filter(({ mirror }) => mirror !== null);
    const back = partnered.map(({ mirror }) => servoOf(robot, mirror ?? 0)?.mirror);
    expect(back).toEqual(partnered.map(({ servo }) => servo));
  });
});

const NOT_OURS = { code: 'notOurs' } as const;
const elbow = { place: 4, name: 'Elbow' };
const ofElbow = (flaw: ServoFlaw, servo = 4) => ({ code: 'servo', servo: { servo, name: 'Elbow' }, flaw });

describe('what is wrong with a robot', () => {
  test.each([
    [{ servo: 5 }, { code: 'servoTwice', servo: 5 }],
    [{ min: 1500, max: 1500 }, ofElbow({ code: 'minNotBelowMax', min: 1500, max: 1500 })],
    [{ home: 400 }, ofElbow({ code: 'home', value: 400, range: { min: 500, max: 2500 } })],
    [{ trim: 20 }, ofElbow({ code: 'beyondBoard', range: { min: 500, max: 2500 } })],
    [{ max: 9000 }, ofElbow({ code: 'beyondBoard', range: { min: 500, max: 2500 } })],
    [{ trim: 126 }, ofElbow({ code: 'trim', value: 126, range: { min: -125, max: 125 } })],
    [{ mirror: 9 }, ofElbow({ code: 'noMirror', mirror: 9 })],
    [{ servo: 7 }, ofElbow({ code: 'number', range: { min: 1, max: 6 } }, 7)],
  ])('%j: %j', (change, flaw) => {
    const robot = withServo(change);
    expect(flawOf(robot)).toEqual(flaw);
    expect(robotFromText(robotToText(robot))).toEqual({ problem: flaw });
  });

  test('a battery alarm at or above its warning is no alarm', () => {
    const at = (warnMv: number, alarmMv: number) =>
      flawOf({ ...ARM, batteryCare: { policy: 'tell', thresholds: { warnMv, alarmMv } } });
    expect(at(7000, 7000)).toEqual({ code: 'alarmNotBelow', warnMv: 7000, alarmMv: 7000 });
    expect(at(7000, 6999)).toBeNull();
  });

  test.each([
    ['', NOT_OURS],
    ['[]', NOT_OURS],
    ['{}', NOT_OURS],
    ['{"format":"servodeck-group","version":1}', NOT_OURS],
    [robotToText(withServo({ min: 1.5 })), { code: 'field', field: 'min', of: elbow }],
    [robotToText(withServo({ degreesPerUnit: 3 })), { code: 'field', field: 'degreesPerUnit', of: elbow }],
    [robotToText(withServo({ place: { x: 50, y: 101 } })), { code: 'field', field: 'place', of: elbow }],
    [robotToText(withServo({ name: ' ' })), { code: 'field', field: 'name', of: { place: 4, name: ' ' } }],
    [robotToText({ ...ARM, name: ' ' }), { code: 'field', field: 'name', of: null }],
    ['{"format":"servodeck-robot","version":1,"robot":7}', { code: 'field', field: 'robot', of: null }],
    [
      robotToText(ARM).replace('"isReversed"', '"colour": 1, "isReversed"'),
      { code: 'strangeField', field: 'colour', of: { place: 1, name: 'gripper 1' } },
    ],
    [robotToText(ARM).replace('"version": 1', '"version": 2'), { code: 'otherVersion' }],
  ])('a file that is none says where', (text, problem) => {
    expect(robotFromText(text)).toEqual({ problem });
  });
});

test('whatever is not called a flaw comes back from its file', () => {
  const change = fc.record(
    {
      name: fc.constantFrom('Elbow', '', ' '),
      min: fc.integer({ min: -50, max: 1500 }),
      max: fc.integer({ min: 1500, max: 2700 }),
      trim: fc.integer({ min: -200, max: 200 }),
      degreesPerUnit: fc.constantFrom(0, 0.09, 2, 3),
    },
    { requiredKeys: [] },
  );
  fc.assert(
    fc.property(change, (wanted) => {
      const robot = withServo(wanted);
      expect('robot' in robotFromText(robotToText(robot))).toBe(flawOf(robot) === null);
    }),
  );
  expect(flawOf(withServo({ min: 900, max: 2000, trim: 126 }))).toEqual(
    ofElbow({ code: 'trim', value: 126, range: { min: -125, max: 125 } }),
  );
});

describe('limits and trims', () => {
  const robot = withServo({ min: 700, max: 2300, home: 1400, trim: 25 });

  test('a target outside is refused with its servo; inside, or of a servo without a description, it is not', () => {
    expect(
      refusedTarget(robot, [
        { servo: 4, position: 700 },
        { servo: 9, position: 1 },
      ]),
    ).toBeNull();
    expect(
      refusedTarget(robot, [
        { servo: 1, position: 600 },
        { servo: 4, position: 2301 },
      ]),
    ).toMatchObject({
      servo: { name: 'Elbow', min: 700, max: 2300 },
      position: 2301,
    });
  });

  test('the board gets the trim on top, and its word is read without', () => {
    expect(onBoard(robot, [{ servo: 4, position: 1000 }])).toEqual([{ servo: 4, position: 1025 }]);
    expect(fromBoard(robot, 4, 1025)).toBe(1000);
  });

  const anyServo = fc.record({
    home: fc.integer({ min: 900, max: 2100 }),
    isReversed: fc.boolean(),
    degreesPerUnit: fc.constantFrom(0.09, 0.135, 0.24),
  });

  test('degrees and positions are two ways to say the same', () => {
    fc.assert(
      fc.property(anyServo, fc.integer({ min: 500, max: 2500 }), (change, at) => {
        const servo = servoOf(withServo(change), 4)!;
        expect(positionOf(servo, degreesOf(servo, at))).toBe(at);
      }),
    );
  });

  test('mirrored twice, a position is where it was, unless a limit stood in the way', () => {
    fc.assert(
      fc.property(anyServo, anyServo, fc.integer({ min: 500, max: 2500 }), (one, other, at) => {
        const from = servoOf(withServo(one), 4)!;
        const to = servoOf(withServo({ ...other, degreesPerUnit: one.degreesPerUnit }), 4)!;
        const there = mirrored(from, to, at);
        if (there > to.min && there < to.max) expect(mirrored(to, from, there)).toBe(at);
      }),
    );
  });
});

test('the published schema is the one that files are read by', () => {
  expect(toJsonSchema(robotFileSchema, { target: 'draft-2020-12', ignoreActions: ['trim'] })).toEqual(
    publishedFile,
  );
});
