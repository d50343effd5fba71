// What volts mean: the curve of a pack, the usual thresholds and a person's own, the board's ceiling.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { FamilyId } from '../codec/families.ts';
import { fedBy, gaugeFraction, percentOf, supplyOf } from './battery.ts';
import { readyRobot } from './readyRobots.ts';
import { flawOf, type BatteryKind, type Robot } from './robot.ts';

const NAMES = { robot: 'Mine', role: String, limb: String };
const robotOn = (board: FamilyId, battery: BatteryKind): Robot =>
  fedBy(readyRobot('plain6', board, NAMES), battery);

describe('what is left of a pack', () => {
  test.each([
    ['2s', [6200, 6600, 7440, 7600, 8380, 8400], [0, 10, 50, 60, 100, 100]],
    ['3s', [9300, 9900, 11_160, 12_570], [0, 10, 50, 100]],
  ] as const)('%s at %j mV is at %j %%', (kind, volts, percents) => {
    const supply = supplyOf(robotOn('bus-ctrl', kind));
    expect(volts.map((mv) => percentOf(mv, supply))).toEqual(percents);
  });

  test('never rises while the volts fall, and stays within 0 and 100', () => {
    fc.assert(
      fc.property(fc.nat(15_000), fc.nat(15_000), fc.constantFrom(2, 3), (one, other, cells) => {
        const lower = percentOf(Math.min(one, other), { cells })!;
        const higher = percentOf(Math.max(one, other), { cells })!;
        expect(lower).toBeGreaterThanOrEqual(0);
        expect(higher).toBeLessThanOrEqual(100);
        expect(lower).toBeLessThanOrEqual(higher);
      }),
    );
  });

  test('of an adapter is unknown', () => {
    expect(percentOf(7500, supplyOf(robotOn('doc', 'adapter')))).toBeNull();
  });
});

describe('a supply', () => {
  test.each([
    ['doc', '2s', { warnMv: 7000, alarmMv: 6600, ceilingMv: 9800 }],
    ['bus-ctrl', '3s', { warnMv: 10_500, alarmMv: 9900, ceilingMv: null }],
    ['lsc-32', 'adapter', { warnMv: 7000, alarmMv: 6400, ceilingMv: null }],
    ['bus-ctrl', 'adapter', { warnMv: 6200, alarmMv: 5600, ceilingMv: null }],
    ['openarm-new', '3s', { ceilingMv: 9800 }],
  ] as const)('on %s from %s has %o', (board, kind, expected) => {
    expect(supplyOf(robotOn(board, kind))).toMatchObject(expected);
  });

  test("a person's own thresholds count until something else feeds the robot", () => {
    const thresholds = { warnMv: 7200, alarmMv: 6800 };
    const robot: Robot = { ...robotOn('doc', '2s'), batteryCare: { policy: 'rest', thresholds } };
    expect(flawOf(robot)).toBeNull();
    expect(supplyOf(robot)).toMatchObject(thresholds);
    expect(fedBy(robot, '3s').batteryCare).toEqual({ policy: 'rest', thresholds: null });
  });

  test('the gauge ends at its ends', () => {
    const supply = supplyOf(robotOn('doc', '2s'));
    expect([5000, 6200, 7300, 8400, 9000].map((mv) => gaugeFraction(mv, supply))).toEqual([0, 0, 0.5, 1, 1]);
  });
});
