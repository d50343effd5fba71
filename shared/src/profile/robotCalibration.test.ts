import { describe, expect, test } from 'vitest';
import type { Calibration } from './calibration.ts';
import { readyRobot, type ReadyRobotId } from './readyRobots.ts';
import {
  beginCalibration,
  endFound,
  isServoDone,
  noteFound,
  partnerDone,
  servoDone,
  settled,
  stepDone,
  stepsOf,
  changeServo,
  removeServo,
} from './robotEdits.ts';
import { servoOf, type Robot } from './robot.ts';

const ready = (id: ReadyRobotId, board: Robot['board']): Robot =>
  readyRobot(id, board, { robot: 'Mine', role: (role, servo) => `${role} ${servo}`, limb: (limb) => limb });
const ARM = ready('arm', 'doc');
const HUMANOID = ready('humanoid16', 'lsc-16');

const after = (robot: Robot, steps: number, from = beginCalibration(robot, null)): Calibration =>
  Array.from({ length: steps }).reduce<Calibration>((calibration) => stepDone(robot, calibration), from);

describe('a calibration', () => {
  test('goes through a servo step by step, then to the next one', () => {
    expect(after(ARM, 0)).toMatchObject({ servo: 1, step: 'min' });
    expect(after(ARM, 2)).toMatchObject({ servo: 1, step: 'home' });
    expect(after(ARM, 4)).toMatchObject({ servo: 2, step: 'min' });
    expect(isServoDone(after(ARM, 3), ARM.servos[0]!)).toBe(false);
    expect(isServoDone(after(ARM, 4), ARM.servos[0]!)).toBe(true);
  });

  test('asks for a trim only where home is not the middle', () => {
    const off = changeServo(ARM, 1, { home: 1520 });
    expect(after(off, 4)).toMatchObject({ servo: 1, step: 'trim' });
    expect(after(off, 5)).toMatchObject({ servo: 2, step: 'min' });
  });

  test('leaves a servo as it is as a whole', () => {
    const stored = servoDone(ARM, after(ARM, 1));
    expect(stored).toMatchObject({ servo: 2, step: 'min' });
    expect(isServoDone(stored, ARM.servos[0]!)).toBe(true);
  });

  test('begun in the middle it comes round to what was left out, and ends with nothing left', () => {
    const begun = beginCalibration(ARM, 5);
    expect(after(ARM, 8, begun)).toMatchObject({ servo: 1, step: 'min' });
    const ended = after(ARM, 24, begun);
    expect(ARM.servos.every((servo) => isServoDone(ended, servo))).toBe(true);
    expect(stepDone(ARM, ended)).toMatchObject({ servo: ended.servo, step: ended.step });
  });

  test('a partner that takes over has only its trim left', () => {
    expect(stepsOf(HUMANOID.servos[2]!)).toContain('partner');
    const atPartner: Calibration = { servo: 3, step: 'partner', done: [] };
    const off = changeServo(changeServo(HUMANOID, 3, { home: 1510 }), 11, { home: 1490 });
    const taken = partnerDone(off, atPartner, 11);
    expect(taken).toMatchObject({ servo: 3, step: 'trim' });
    const left = stepsOf(HUMANOID.servos[10]!).filter(
      (step) => !taken.done.some((one) => one.servo === 11 && one.step === step),
    );
    expect(left).toEqual(['trim']);
  });

  test('finds a place when its servo or its step is gone', () => {
    const partnerless = removeServo(HUMANOID, 11);
    expect(settled(partnerless, { servo: 3, step: 'partner', done: [] })).toMatchObject({ step: 'trim' });
    expect(settled(partnerless, { servo: 11, step: 'home', done: [] })).toMatchObject({ servo: 1 });
    const stored: Calibration = { servo: 3, step: 'home', done: [] };
    expect(settled(partnerless, stored)).toBe(stored);
  });
});

describe('the ends of a servo', () => {
  /** Lowest is asked for first, highest then. */
  const found = (lowest: number, highest: number): Robot => {
    const begun = beginCalibration(ARM, 2);
    const first = servoOf(ARM, 2)!;
    const half = endFound(ARM, begun, first, 'min', lowest);
    const noted = noteFound(begun, first, 'min', lowest);
    return endFound(half, noted, servoOf(half, 2)!, 'max', highest);
  };

  test('are what they are, though the servo sits the other way round', () => {
    expect(servoOf(found(1745, 1100), 2)).toMatchObject({ min: 1100, home: 1500, max: 1745 });
    expect(found(1745, 1100)).toEqual(found(1100, 1745));
  });

  test('take home along only where it is outside of both', () => {
    expect(servoOf(found(1600, 2200), 2)).toMatchObject({ min: 1600, home: 1600, max: 2200 });
    expect(servoOf(found(2200, 1600), 2)).toMatchObject({ min: 1600, home: 1600, max: 2200 });
  });

  test('of another servo have nothing to do with it', () => {
    const noted = noteFound(beginCalibration(ARM, 2), servoOf(ARM, 2)!, 'min', 1745);
    expect(servoOf(endFound(ARM, noted, servoOf(ARM, 3)!, 'max', 2000), 3)).toMatchObject({
      min: 500,
      max: 2000,
    });
  });
});
