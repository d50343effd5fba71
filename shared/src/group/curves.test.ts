import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { evenly } from '../testing/cases.ts';
import { ANY_EASING } from '../testing/groups.ts';
import {
  curveOf,
  EASINGS,
  handlesOf,
  HIGHEST_HANDLE,
  LOWEST_HANDLE,
  partOf,
  sameEasing,
  type Bezier,
} from './curves.ts';
import { reversedEasing } from './timeEdits.ts';

const shares = evenly(0, 1);
const time = fc.double({ min: 0, max: 1, noNaN: true });
const way = fc.double({ min: LOWEST_HANDLE, max: HIGHEST_HANDLE, noNaN: true });
const bezier: fc.Arbitrary<Bezier> = fc.tuple(time, way, time, way);
const NAMES = EASINGS.filter((easing) => easing !== 'hold');

describe.each(EASINGS)('the curve %s', (easing) => {
  test('leads from nothing to everything and never back', () => {
    const curve = curveOf(easing);
    expect([curve.at(0), curve.at(1)]).toEqual([0, 1]);
    fc.assert(
      fc.property(shares, shares, (one, other) => {
        expect(curve.at(Math.max(one, other))).toBeGreaterThanOrEqual(curve.at(Math.min(one, other)));
      }),
    );
  });
});

const steepness = (at: (share: number) => number, share: number) =>
  (at(share + 1e-6) - at(share - 1e-6)) / 2e-6;

test.each(NAMES.filter((easing) => easing !== 'linear'))(
  'the curve %s is as steep as wanted where it says so',
  (easing) => {
    const curve = curveOf(easing);
    fc.assert(
      fc.property(fc.double({ min: 0.01, max: 1.99, noNaN: true }), (slope) => {
        for (const share of curve.asSteepAs(slope)) expect(steepness(curve.at, share)).toBeCloseTo(slope, 3);
      }),
    );
  },
);

test.each(ANY_EASING.filter((easing) => easing !== 'hold'))(
  'the curve %s backwards is its mirror image',
  (easing) => {
    const [curve, back] = [curveOf(easing), curveOf(reversedEasing(easing))];
    fc.assert(
      fc.property(shares, (share) => {
        expect(back.at(share)).toBeCloseTo(1 - curve.at(1 - share), 6);
      }),
    );
  },
);

describe('a curve by its handles', () => {
  test('begins and ends at its keys, and is one value at every time between', () => {
    fc.assert(
      fc.property(bezier, shares, (handles, share) => {
        const curve = curveOf(handles);
        expect(curve.at(0)).toBeCloseTo(0, 9);
        expect(curve.at(1)).toBeCloseTo(1, 9);
        expect(curve.at(share)).toBeGreaterThanOrEqual(LOWEST_HANDLE);
        expect(curve.at(share)).toBeLessThanOrEqual(HIGHEST_HANDLE);
      }),
    );
  });

  test('is nowhere farther from a straight way than at its ends and where it says', () => {
    const slopes = fc.double({ min: -4, max: 4, noNaN: true });
    fc.assert(
      fc.property(bezier, slopes, (handles, slope) => {
        const curve = curveOf(handles);
        const miss = (share: number) => curve.at(share) - slope * share;
        const known = [0, 1, ...curve.asSteepAs(slope)].map(miss);
        const sampled = Array.from({ length: 201 }, (_, step) => miss(step / 200));
        expect(Math.max(...sampled)).toBeLessThanOrEqual(Math.max(...known) + 1e-4);
        expect(Math.min(...sampled)).toBeGreaterThanOrEqual(Math.min(...known) - 1e-4);
      }),
    );
  });

  test.each(NAMES)('of %s is that curve, or so near that nobody sees it', (easing) => {
    const [handles, curve] = [curveOf(handlesOf(easing) ?? [0, 0, 0, 0]), curveOf(easing)];
    const decimals = easing === 'inOut' ? 1 : 6;
    for (let step = 0; step <= 50; step++)
      expect(handles.at(step / 50)).toBeCloseTo(curve.at(step / 50), decimals);
  });

  test('cut in two at any time is gone as before', () => {
    const mild = fc.double({ min: 0, max: 1, noNaN: true });
    const easings = fc.oneof(
      fc.tuple(time, mild, time, mild),
      fc.constantFrom(...NAMES.filter((easing) => easing !== 'inOut')),
    );
    fc.assert(
      fc.property(easings, fc.double({ min: 0.05, max: 0.95, noNaN: true }), shares, (easing, at, share) => {
        const whole = curveOf(easing);
        const cutAt = whole.at(at);
        // Steep to the side of a height of nearly nothing, no handle that a document takes says it.
        fc.pre(cutAt > 0.3 && cutAt < 0.7);
        const [before, behind] = (['before', 'behind'] as const).map((side) =>
          curveOf(partOf(easing, at, side)),
        );
        expect(cutAt * before!.at(share)).toBeCloseTo(whole.at(at * share), 1);
        expect(cutAt + (1 - cutAt) * behind!.at(share)).toBeCloseTo(whole.at(at + (1 - at) * share), 1);
      }),
    );
    const [one, other] = (['before', 'behind'] as const).map((side) => partOf('in', 0.5, side));
    expect(curveOf(one!).at(0.5)).toBeCloseTo(0.25, 3);
    expect(curveOf(other!).at(0.5)).toBeCloseTo((0.75 ** 2 - 0.25) / 0.75, 3);
  });

  test('is the same by its numbers', () => {
    expect(sameEasing([0.1, 0, 0.9, 1], [0.1, 0, 0.9, 1])).toBe(true);
    expect(sameEasing([0.1, 0, 0.9, 1], [0.1, 0, 0.9, 1.1])).toBe(false);
    expect(sameEasing([0, 0, 1, 1], 'linear')).toBe(false);
  });
});
