import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { readyRobot } from '#shared/profile/readyRobots.ts';
import type { RobotServo } from '#shared/profile/robot.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { robotNames } from '../../i18n/sentences.ts';
import { scaleOf, stepped } from './scale.ts';

const servoOn = (board: 'doc' | 'bus-ctrl', change: Partial<RobotServo> = {}): RobotServo => ({
  ...readyRobot('plain6', board, robotNames('plain6')).servos[0]!,
  ...change,
});

const servos = fc.record({
  board: fc.constantFrom('doc' as const, 'bus-ctrl' as const),
  isReversed: fc.boolean(),
  home: fc.integer({ min: 650, max: 900 }),
});

describe('positions as the person reads them', () => {
  test('in the unit of the board', () => {
    const scale = scaleOf(servoOn('doc', { min: 600 }), FAMILIES.doc, 'board');
    expect(scale).toMatchObject({ min: 600, max: 2500, unit: 'µs' });
    expect(scale.text(1499.6)).toBe('1500 µs');
    expect(stepped(scale, 1500, -1)).toBe(1499);
    expect(stepped(scale, 605, -10)).toBe(600);
  });

  test('in degrees away from home, in the direction of the servo', () => {
    expect(scaleOf(servoOn('doc'), FAMILIES.doc, 'degrees')).toMatchObject({ min: -90, max: 90 });
    const reversed = scaleOf(servoOn('doc', { isReversed: true }), FAMILIES.doc, 'degrees');
    expect(reversed.text(1600)).toBe('-9.0°');
    expect(stepped(reversed, 1500, 1)).toBe(1489);
    expect(scaleOf(servoOn('bus-ctrl'), FAMILIES['bus-ctrl'], 'degrees').text(600)).toBe('24°');
    expect(reversed.text(1500)).toBe('0.0°');
  });

  test('of a way of a few degrees in tenths, whatever the unit', () => {
    const short = scaleOf(
      servoOn('bus-ctrl', { min: 500, max: 501, home: 500 }),
      FAMILIES['bus-ctrl'],
      'degrees',
    );
    expect(short).toMatchObject({ min: 0, max: 0.2, decimals: 1, step: 0.3 });
    expect(stepped(short, 500, 1)).toBe(501);
    expect(stepped(short, 501, -1)).toBe(500);
  });

  test('a step goes on until the end', () => {
    fc.assert(
      fc.property(servos, fc.nat(400), fc.nat(100), ({ board, ...change }, below, above) => {
        const servo = servoOn(board, { ...change, min: change.home - below, max: change.home + above + 1 });
        const scale = scaleOf(servo, FAMILIES[board], 'degrees');
        const end = scale.position(scale.max);
        for (
          let at = scale.position(scale.min), before = NaN;
          at !== end;
          at = stepped(scale, at, scale.step)
        ) {
          expect(at).not.toBe(before);
          before = at;
        }
      }),
    );
  });

  test('what stands for an end leads to it', () => {
    fc.assert(
      fc.property(servos, fc.nat(400), fc.nat(100), ({ board, ...change }, below, above) => {
        const servo = servoOn(board, { ...change, min: change.home - below, max: change.home + above + 1 });
        const scale = scaleOf(servo, FAMILIES[board], 'degrees');
        for (const end of [servo.min, servo.max]) expect(scale.position(scale.shown(end))).toBe(end);
      }),
    );
  });

  test('what is shown is within the limits and leads to what is shown again', () => {
    fc.assert(
      fc.property(servos, fc.nat(1000), ({ board, ...change }, at) => {
        const servo = servoOn(board, change);
        const scale = scaleOf(servo, FAMILIES[board], 'degrees');
        const shown = scale.shown(servo.min + at);
        expect(shown).toBeGreaterThanOrEqual(scale.min);
        expect(shown).toBeLessThanOrEqual(scale.max);
        expect(scale.shown(scale.position(shown))).toBe(shown);
      }),
    );
  });

  test('ten steps of a degree are ten degrees', () => {
    fc.assert(
      fc.property(servos, ({ board, ...change }) => {
        const servo = servoOn(board, change);
        const scale = scaleOf(servo, FAMILIES[board], 'degrees');
        let position = servo.home;
        for (let step = 1; step <= 10; step += 1) position = stepped(scale, position, 1);
        expect(scale.shown(position)).toBe(10);
      }),
    );
  });
});
