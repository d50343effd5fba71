// Edits of robots: whatever they are given, a sound robot stays sound or its flaw is named, and mirrors stay pairs.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { FAMILIES } from '../codec/families.ts';
import { readyRobot, type ReadyRobotId } from './readyRobots.ts';
import { flawOf, limitsOnBoard, onBoard, servoOf, type Robot } from './robot.ts';
import {
  addServo,
  changeServo,
  fromPartner,
  homeAtCentre,
  pair,
  reachOf,
  removeServo,
  renumber,
  setEnds,
} from './robotEdits.ts';

const ready = (id: ReadyRobotId, board: Robot['board']): Robot =>
  readyRobot(id, board, { robot: 'Mine', role: (role, servo) => `${role} ${servo}`, limb: (limb) => limb });
const ARM = ready('arm', 'doc');
const HUMANOID = ready('humanoid16', 'lsc-16');

const mirrorsArePairs = (robot: Robot): boolean =>
  robot.servos.every(({ servo, mirror }) => mirror === null || servoOf(robot, mirror)?.mirror === servo);

describe('servos come and go', () => {
  test('the lowest free number is taken, until the board has no more', () => {
    const gap = removeServo(HUMANOID, 3);
    expect(servoOf(gap, 11)?.mirror).toBeNull();
    const filled = addServo(gap, (servo) => `Servo ${servo}`)!;
    expect(filled.servos.at(-1)).toMatchObject({ servo: 3, name: 'Servo 3', home: 1500 });
    expect(flawOf(filled)).toBeNull();
    expect(addServo(filled, String)).toBeNull();
  });

  test('a partner follows a new number', () => {
    const robot = renumber(ready('humanoid16', 'lsc-32'), 3, 20);
    expect(servoOf(robot, 11)?.mirror).toBe(20);
    expect(flawOf(robot)).toBeNull();
  });

  test('mirrors are pairs, whichever way they are given', () => {
    const pairing = fc.tuple(
      fc.integer({ min: 1, max: 16 }),
      fc.option(fc.integer({ min: 1, max: 16 }), { nil: null }),
    );
    fc.assert(
      fc.property(fc.array(pairing, { maxLength: 8 }), (pairings) => {
        const robot = pairings
          .filter(([servo, partner]) => servo !== partner)
          .reduce((all, [servo, partner]) => pair(all, servo, partner), HUMANOID);
        expect(mirrorsArePairs(robot)).toBe(true);
      }),
    );
  });
});

describe('calibrating', () => {
  test('an end takes home along', () => {
    expect(servoOf(setEnds(ARM, 4, [1600, 2500], 1500), 4)).toMatchObject({
      min: 1600,
      home: 1600,
      max: 2500,
    });
    expect(servoOf(setEnds(ARM, 4, [500, 2000], 1500), 4)).toMatchObject({ min: 500, home: 1500, max: 2000 });
  });

  test('the lower end is the lowest, whichever was found first', () => {
    const position = fc.integer({ min: 500, max: 2500 });
    fc.assert(
      fc.property(position, position, position, (one, other, home) => {
        fc.pre(one !== other);
        const robot = setEnds(ARM, 4, [one, other], home);
        expect(flawOf(robot)).toBeNull();
        expect(robot).toEqual(setEnds(ARM, 4, [other, one], home));
      }),
    );
  });

  test('a partner is the mirror image, and the image of the image the first one', () => {
    const knee = { ...servoOf(HUMANOID, 3)!, min: 900, home: 1400, max: 2000, isReversed: true };
    const other = { ...servoOf(HUMANOID, 11)!, ...fromPartner(HUMANOID, knee) };
    expect(other).toMatchObject({ min: 1000, home: 1600, max: 2100, isReversed: false });
    expect(flawOf(changeServo(HUMANOID, 11, other))).toBeNull();
    expect({ ...knee, ...fromPartner(HUMANOID, other) }).toEqual(knee);
  });

  test('with home at the centre the servo does on the board what it did before', () => {
    const { centre } = FAMILIES.doc;
    const figures = fc.record({
      home: fc.integer({ min: centre - 125, max: centre + 125 }),
      min: fc.integer({ min: 500, max: 1300 }),
      max: fc.integer({ min: 1700, max: 2500 }),
    });
    fc.assert(
      fc.property(figures, (change) => {
        const before = changeServo(ARM, 4, change);
        const after = changeServo(before, 4, homeAtCentre(before, servoOf(before, 4)!)!);
        expect(flawOf(after)).toBeNull();
        const home = (robot: Robot) => onBoard(robot, [{ servo: 4, position: servoOf(robot, 4)!.home }]);
        expect(home(after)).toEqual(home(before));
        const [was, is] = [before, after].map((robot) => limitsOnBoard(robot)[3]!);
        expect(is!.min).toBeGreaterThanOrEqual(was!.min);
        expect(is!.max).toBeLessThanOrEqual(was!.max);
      }),
    );
  });

  test('a home too far off is left to the horn of the servo', () => {
    expect(homeAtCentre(ARM, { ...servoOf(ARM, 4)!, home: 1700 })).toBeNull();
  });

  test('the reach is what the board does, seen without the trim', () => {
    expect(reachOf(ARM, { ...servoOf(ARM, 4)!, trim: 100 })).toEqual({ min: 400, max: 2400 });
    expect(reachOf(ARM, { ...servoOf(ARM, 4)!, trim: -100 })).toEqual({ min: 600, max: 2500 });
  });
});
