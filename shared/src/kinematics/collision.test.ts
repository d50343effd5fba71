// Where a model may touch itself or the floor, on models small enough to know it.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { evenly } from '../testing/cases.ts';
import type { Vec3, LinkModel, ModelLink } from './model.ts';
import { collisions, collisionsOf, STEP_MM, type TimedAngles } from './collision.ts';

const LEVEL: Vec3 = [0, 0, 0];

const rod = (lengthM: number): ModelLink['shapes'] => [
  { shape: 'box', size: [0.01, 0.01, lengthM], at: [0, 0, lengthM / 2], rpy: LEVEL },
];

const link = (name: string, on: string, at: Vec3, axis: Vec3, servo: number, lengthM: number): ModelLink => ({
  name,
  shapes: rod(lengthM),
  mount: { on, at, rpy: LEVEL, axis, servo, share: 1, offset: 0 },
});

const BASE: ModelLink = {
  name: 'base',
  shapes: [{ shape: 'box', size: [0.1, 0.1, 0.02], at: [0, 0, 0.01], rpy: LEVEL }],
  mount: null,
};

/** Straight up at 0: three rods, each turned about y. */
const ARM: LinkModel = {
  links: [
    BASE,
    link('upper', 'base', [0, 0, 0.03], [0, 1, 0], 1, 0.08),
    link('fore', 'upper', [0, 0, 0.09], [0, 1, 0], 2, 0.08),
    link('hand', 'fore', [0, 0, 0.09], [0, 1, 0], 3, 0.04),
  ],
  standsOnFloor: true,
};

/** Two rods beside each other, each turned about x. */
const PAIR: LinkModel = {
  links: [
    { ...BASE, shapes: [] },
    link('left', 'base', [0, 0.05, 0.2], [1, 0, 0], 1, 0.1),
    link('right', 'base', [0, -0.05, 0.2], [1, 0, 0], 2, 0.1),
  ],
  standsOnFloor: false,
};

/** Angles of servo 1, 2 and 3, a second apart. */
const motion = (...poses: readonly (readonly number[])[]): readonly TimedAngles[] =>
  poses.map((angles, index) => ({
    atMs: index * 1000,
    angles: new Map(angles.map((angle, servo) => [servo + 1, angle])),
  }));

const small = evenly(-0.3, 0.3);

describe('a robot touches itself', () => {
  test('nowhere while it moves about straight up', () => {
    fc.assert(
      fc.property(fc.array(fc.tuple(small, small, small), { minLength: 1, maxLength: 8 }), (poses) => {
        expect(collisionsOf(ARM, motion(...poses))).toEqual([]);
      }),
    );
  });

  test('where two links are put through one another, from then on until they part', () => {
    const [place, ...others] = collisionsOf(PAIR, motion([0, 0], [0.8, -0.8], [0, 0]));
    expect(others).toEqual([]);
    expect(place).toMatchObject({ kind: 'self', links: ['left', 'right'], servos: [1, 2] });
    // The inner faces of the rods meet where 45 mm are left, at the end of a rod and of its half width.
    const meetsAt = ((): number => {
      let angle = 0;
      while (0.1 * Math.sin(angle) + 0.005 * Math.cos(angle) < 0.05) angle += 1e-5;
      return angle / 0.8;
    })();
    expect(Math.abs((place?.fromMs ?? 0) - meetsAt * 1000)).toBeLessThan(20);
    expect(Math.abs((place?.toMs ?? 0) - (2 - meetsAt) * 1000)).toBeLessThan(60);
  });

  test('also where it only passes through', () => {
    const swings = motion([0.9, 0], [0.9, -0.9], [-0.9, -0.9], [-0.9, 0.9]);
    expect(collisionsOf(PAIR, swings).map(({ links }) => links)).toEqual([['left', 'right']]);
  });

  test('as any pose between says that is looked at by itself', () => {
    const turn = evenly(-1.5, 1.5);
    fc.assert(
      fc.property(fc.tuple(turn, turn), fc.tuple(turn, turn), evenly(0, 1), (from, to, share) => {
        const at = from.map((angle, servo) => angle + ((to[servo] ?? 0) - angle) * share);
        const isHit = collisionsOf(PAIR, motion(at)).length > 0;
        const places = collisionsOf(PAIR, motion(from, to));
        // What is deep enough is found, and found there. How deep is seen by moving both towards where they meet by what is allowed.
        const isDeep = [-1, 1].every((way) =>
          [-1, 1].every(
            (other) =>
              collisionsOf(
                PAIR,
                motion(at.map((angle, servo) => angle + (servo === 0 ? way : other) * (STEP_MM / 100))),
              ).length > 0,
          ),
        );
        if (isHit && isDeep)
          expect(places.some(({ fromMs, toMs }) => fromMs <= share * 1000 && share * 1000 <= toMs)).toBe(
            true,
          );
      }),
    );
  });

  test('not where neighbours fold, nor where one servo closes both', () => {
    expect(collisionsOf({ ...ARM, standsOnFloor: false }, motion([0, 0, 0], [0, 0, 3]))).toEqual([]);
    const jaws = {
      ...PAIR,
      links: PAIR.links.map((one) => ({
        ...one,
        mount: one.mount && { ...one.mount, servo: 1, share: one.name === 'left' ? 1 : -1 },
      })),
    };
    expect(collisionsOf(jaws, motion([0], [1.2]))).toEqual([]);
  });

  test('not where links overlap as they are built', () => {
    const near: LinkModel = {
      ...PAIR,
      links: PAIR.links.map((one) => ({ ...one, mount: one.mount && { ...one.mount, at: [0, 0, 0.2] } })),
    };
    expect(collisionsOf(near, motion([0, 0], [0.5, -0.5]))).toEqual([]);
  });
});

describe('a robot touches the floor', () => {
  test('where its hand goes below it', () => {
    const [first] = collisionsOf(ARM, motion([0, 0, 0], [1.5, 1, 0], [0, 0, 0]));
    expect(first).toMatchObject({ kind: 'floor', links: ['hand'], servos: [3] });
  });

  test('at no time if it rests on whatever is lowest', () => {
    const legged = { ...ARM, standsOnFloor: false };
    expect(
      collisionsOf(legged, motion([0, 0, 0], [1.5, 1, 0])).filter(({ kind }) => kind === 'floor'),
    ).toEqual([]);
  });

  test('as long as it stays there, to the end', () => {
    const [first] = collisionsOf(ARM, motion([1.5, 1, 0], [1.5, 1, 0]));
    expect(first).toMatchObject({ fromMs: 0, toMs: 1000 });
  });
});

test('the answer is the same each time, and can be paused on the way', () => {
  const there = motion([0, 0], [0.8, -0.8], [0, 0]);
  const run = collisions(PAIR, there);
  let [rounds, step] = [0, run.next()];
  for (; step.done !== true; step = run.next()) rounds += 1;
  expect(rounds).toBeGreaterThan(1);
  expect(step.value).toEqual(collisionsOf(PAIR, there));
});

test('a motion of no pose has no place, one of a single pose is looked at', () => {
  expect(collisionsOf(PAIR, [])).toEqual([]);
  expect(collisionsOf(PAIR, motion([0.8, -0.8]))).toHaveLength(1);
});
