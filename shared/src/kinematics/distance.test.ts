// Distances of convex solids against formulas and against points sampled on them.

import fc from 'fast-check';
import { expect, test } from 'vitest';
import { evenly } from '../testing/cases.ts';
import { added, lengthOf, minus, rotated, rotationOfRpy, type Vec3 } from './model.ts';
import { ACCURACY_M, capsule, distanceM, heightOf, type PlacedSolid, solidOf } from './distance.ts';

const triple = (from: number, to: number): fc.Arbitrary<Vec3> =>
  fc.tuple(evenly(from, to), evenly(from, to), evenly(from, to));
const place = fc
  .record({ at: triple(-0.1, 0.1), rpy: triple(-Math.PI, Math.PI) })
  .map(({ at, rpy }) => ({ at, rotation: rotationOfRpy(rpy) }));

const CAPSULE = fc.record({ lengthM: evenly(0, 0.1), radiusM: evenly(0.001, 0.03), place });
type Capsule = typeof CAPSULE extends fc.Arbitrary<infer Value> ? Value : never;
const ofCapsule = ({ lengthM, radiusM, place: where }: Capsule): PlacedSolid => ({
  solid: capsule(lengthM, radiusM),
  place: where,
});

const size = evenly(0.005, 0.05);
const solid = fc.oneof(
  fc.tuple(size, size, size).map((sizes) => solidOf({ shape: 'box', size: sizes })),
  fc.tuple(size, size).map((sizes) => solidOf({ shape: 'cylinder', size: sizes })),
  size.map((radius) => solidOf({ shape: 'sphere', size: [radius] })),
  fc.tuple(evenly(0, 0.1), size).map(([lengthM, radiusM]) => capsule(lengthM, radiusM)),
);
const placedSolid: fc.Arbitrary<PlacedSolid> = fc.record({ solid, place });

const onPlace = ({ place: { at, rotation } }: PlacedSolid, point: Vec3): Vec3 =>
  added(at, rotated(rotation, point));

const SAMPLES = 200;

/** Along the axis of one, each time against the whole axis of the other. */
function sampledM(one: Capsule, other: Capsule): number {
  const along = (of: Capsule, share: number): Vec3 =>
    onPlace(ofCapsule(of), [0, 0, of.lengthM * (share - 0.5)]);
  const [start, end] = [along(other, 0), along(other, 1)];
  const way = minus(end, start);
  const square = lengthOf(way) ** 2;
  let least = Infinity;
  for (let step = 0; step <= SAMPLES; step++) {
    const from = minus(along(one, step / SAMPLES), start);
    const wanted = square === 0 ? 0 : (from[0] * way[0] + from[1] * way[1] + from[2] * way[2]) / square;
    const share = Math.min(1, Math.max(0, wanted));
    least = Math.min(least, lengthOf(minus(from, [way[0] * share, way[1] * share, way[2] * share])));
  }
  return least - one.radiusM - other.radiusM;
}

test('capsules are as far apart as the points sampled on their axes', () => {
  fc.assert(
    fc.property(CAPSULE, CAPSULE, (one, other) => {
      const exact = distanceM(ofCapsule(one), ofCapsule(other));
      const sampled = sampledM(one, other);
      expect(exact).toBeLessThanOrEqual(sampled + ACCURACY_M);
      expect(exact).toBeGreaterThanOrEqual(sampled - one.lengthM / SAMPLES - ACCURACY_M);
    }),
  );
});

test('the distance of two solids is the same from both sides', () => {
  fc.assert(
    fc.property(placedSolid, placedSolid, (one, other) => {
      const [there, back] = [distanceM(one, other), distanceM(other, one)];
      expect(Math.abs(there - back)).toBeLessThanOrEqual(2 * ACCURACY_M);
    }),
  );
});

test('no two points of solids are nearer than their distance', () => {
  const inBox = triple(-1, 1);
  fc.assert(
    fc.property(
      placedSolid,
      placedSolid,
      fc.array(fc.tuple(inBox, inBox), { minLength: 30 }),
      (one, other, points) => {
        const apartM = distanceM(one, other);
        for (const [mine, theirs] of points) {
          const [from, to] = [pointIn(one, mine), pointIn(other, theirs)];
          expect(lengthOf(minus(from, to)) - one.solid.roundM - other.solid.roundM).toBeGreaterThanOrEqual(
            apartM - ACCURACY_M,
          );
        }
      },
    ),
  );
});

/** A point of the core; each coordinate a share of its half. */
function pointIn(of: PlacedSolid, [x, y, z]: Vec3): Vec3 {
  const { core, half } = of.solid;
  const wide = core === 'cylinder' ? Math.max(1, Math.hypot(x, y)) : 1;
  return onPlace(of, [(x / wide) * half[0], (y / wide) * half[1], z * half[2]]);
}

test('a solid that is moved away along an axis is farther by as much', () => {
  const box = solidOf({ shape: 'box', size: [0.02, 0.04, 0.06] });
  fc.assert(
    fc.property(evenly(0.031, 0.2), (apart) => {
      const upright = { rotation: rotationOfRpy([0, 0, 0]) };
      const [here, there] = [
        { solid: box, place: { at: [0, 0, 0] as Vec3, ...upright } },
        {
          solid: solidOf({ shape: 'cylinder', size: [0.01, 0.02] }),
          place: { at: [0, 0, apart] as Vec3, ...upright },
        },
      ];
      expect(distanceM(here, there)).toBeCloseTo(Math.max(0, apart - 0.04), 4);
    }),
  );
});

test('with a share allowed it is less by no more than that, and of the same sign', () => {
  fc.assert(
    fc.property(placedSolid, placedSolid, (one, other) => {
      const [exact, rough] = [distanceM(one, other), distanceM(one, other, 0.1)];
      expect(rough).toBeLessThanOrEqual(exact + ACCURACY_M);
      if (exact > ACCURACY_M) expect(rough).toBeGreaterThanOrEqual(exact / 1.1 - 2 * ACCURACY_M);
    }),
  );
});

test('a box on its corner is as low as its half diagonal', () => {
  const cube = solidOf({ shape: 'box', size: [0.02, 0.02, 0.02] });
  const rotation = rotationOfRpy([Math.PI / 4, Math.asin(1 / Math.sqrt(3)), 0]);
  expect(heightOf({ solid: cube, place: { at: [0, 0, 0.1], rotation } })).toBeCloseTo(
    0.1 - 0.01 * Math.sqrt(3),
    5,
  );
});

/** The corners of a box as a hull. */
const hullOf = ([x, y, z]: Vec3): number[] =>
  [-1, 1].flatMap((a) =>
    [-1, 1].flatMap((b) => [-1, 1].flatMap((c) => [(a * x) / 2, (b * y) / 2, (c * z) / 2])),
  );

test('a hull of the corners of a box is that box', () => {
  const sizes = triple(0.005, 0.05);
  fc.assert(
    fc.property(sizes, place, placedSolid, (box, where, other) => {
      const [one, same] = [
        solidOf({ shape: 'box', size: box }),
        solidOf({ shape: 'hull', size: hullOf(box) }),
      ].map((made) => ({ solid: made, place: where }));
      expect(same!.solid.radiusM).toBeCloseTo(one!.solid.radiusM, 9);
      expect(heightOf(same!)).toBeCloseTo(heightOf(one!), 9);
      const [exact, found] = [distanceM(one!, other), distanceM(same!, other)];
      if (exact > ACCURACY_M) expect(Math.abs(found - exact)).toBeLessThanOrEqual(2 * ACCURACY_M);
      else expect(found).toBeLessThanOrEqual(2 * ACCURACY_M);
    }),
  );
});
