import fc from 'fast-check';
import { safeParse } from 'valibot';
import { describe, expect, test } from 'vitest';
import { flawOfGroup, groupSchema } from './group.ts';
import { frozen, refsOf, shapeOf } from '../testing/groups.ts';
import { simplify, type Sample } from './simplify.ts';
import { positionAt, tracksOf } from './tracks.ts';

const OPTIONS = { name: 'Wave', unit: 'us', maxErrorUnits: 5, leadMs: 800 } as const;

/** Reads of several servos at once, or each at times of its own. */
const someSamples = fc
  .tuple(
    fc.array(fc.integer({ min: 1, max: 150 }), { minLength: 1, maxLength: 40 }),
    fc.array(fc.array(fc.integer({ min: -60, max: 60 }), { minLength: 40, maxLength: 40 }), {
      minLength: 1,
      maxLength: 4,
    }),
    fc.boolean(),
    fc.integer({ min: 0, max: 1_000_000 }),
  )
  .map(([gaps, steps, isTogether, begunMs]) =>
    steps.flatMap((own, index) => {
      let atMs = begunMs + (isTogether ? 0 : 7 * index);
      let position = 1500;
      return gaps.map((gapMs, step): Sample => {
        atMs += gapMs;
        position += own[step] ?? 0;
        return { atMs, servo: index + 1, position };
      });
    }),
  );

describe('a recorded motion as keys', () => {
  test('has every servo within the error of each sample', () => {
    fc.assert(
      fc.property(someSamples, fc.integer({ min: 0, max: 80 }), (samples, maxErrorUnits) => {
        const group = simplify(frozen(samples), { ...OPTIONS, maxErrorUnits });
        const tracks = tracksOf(group);
        const begunMs = Math.min(...samples.map(({ atMs }) => atMs));
        const misses = samples.map(({ atMs, servo, position }) =>
          Math.abs(positionAt(tracks.get(servo)!, atMs - begunMs + OPTIONS.leadMs)! - position),
        );
        expect(Math.max(...misses)).toBeLessThanOrEqual(maxErrorUnits + 1e-6);
        expect(refsOf(group).length).toBeLessThanOrEqual(samples.length);
        expect(flawOfGroup(group)).toBeNull();
        expect(safeParse(groupSchema, group).issues).toBeUndefined();
      }),
    );
  });

  const straight = (servo: number, rise: number): Sample[] =>
    Array.from({ length: 101 }, (_, step) => ({
      atMs: 5000 + 20 * step,
      servo,
      position: 1000 + rise * step,
    }));

  test('that is straight is its two ends, behind the way to its beginning', () => {
    const group = simplify([...straight(1, 3), ...straight(2, -7)], OPTIONS);
    expect(
      group.frames.map(({ durationMs, targets }) => [durationMs, targets.map(({ position }) => position)]),
    ).toEqual([
      [800, [1000, 1000]],
      [2000, [1300, 300]],
    ]);
  });

  test('has its corners at common times where that costs nothing', () => {
    const bent = (servo: number, corner: number): Sample[] =>
      straight(servo, 0).map((sample, step) => ({ ...sample, position: 1000 + Math.abs(step - corner) }));
    const samples = [...bent(1, 40), ...bent(2, 42)];
    expect(simplify(samples, OPTIONS).frames).toHaveLength(3);
    expect(simplify(samples, { ...OPTIONS, maxErrorUnits: 1 }).frames).toHaveLength(4);
  });

  test('with every sample needed keeps every sample', () => {
    const zigzag = straight(1, 0).map((sample, step) => ({ ...sample, position: 1000 + 100 * (step % 2) }));
    expect(shapeOf(simplify(zigzag, OPTIONS))[0]!.keys).toHaveLength(101);
  });

  test('without samples is an empty group', () => {
    expect(simplify([], OPTIONS).frames).toEqual([]);
  });
});
