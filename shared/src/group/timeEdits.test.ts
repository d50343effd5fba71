import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { evenly } from '../testing/cases.ts';
import { EASINGS } from './curves.ts';
import { emptyGroup, totalDurationMs } from './group.ts';
import { frozen, shapeOf, someGroup, someRange, withGroup } from '../testing/groups.ts';
import { setKey } from './keyEdits.ts';
import {
  deleteTime,
  insertTime,
  reverse,
  scaleTime,
  setDuration,
  stretch,
  stretchBack,
} from './timeEdits.ts';
import { frameEnds, positionAt, tracksOf } from './tracks.ts';

const STAY = { ripple: false };
const RIPPLE = { ripple: true };

describe('time', () => {
  const anyScene = withGroup(someGroup(), someRange);
  const spaced = someGroup({ durationMs: fc.integer({ min: 1, max: 900 }) });

  test('inserted and deleted again is as it was', () => {
    fc.assert(
      fc.property(anyScene, ([group, range]) => {
        const longer = insertTime(group, range.fromMs, range.toMs - range.fromMs);
        expect(deleteTime(longer, range)).toEqual(group);
      }),
    );
  });

  test('deleted takes its keys along and brings the rest closer', () => {
    fc.assert(
      fc.property(withGroup(spaced, someRange), ([group, range]) => {
        const keptAt = (atMs: number) => atMs <= range.fromMs || atMs > range.toMs;
        const moved = (atMs: number) => (atMs > range.toMs ? atMs - (range.toMs - range.fromMs) : atMs);
        const remaining = shapeOf(group).map(({ servo, keys }) => ({
          servo,
          keys: keys.filter(({ atMs }) => keptAt(atMs)).map((key) => ({ ...key, atMs: moved(key.atMs) })),
        }));
        expect(shapeOf(deleteTime(group, range))).toEqual(remaining.filter(({ keys }) => keys.length > 0));
      }),
    );
  });

  test('stretched and pressed again is as it was', () => {
    fc.assert(
      fc.property(anyScene, ([group, { fromMs, toMs }]) => {
        const longer = stretch(group, { fromMs, toMs }, 2, RIPPLE);
        expect(stretch(longer, { fromMs, toMs: 2 * toMs - fromMs }, 0.5, RIPPLE)).toEqual(group);
        expect(scaleTime(scaleTime(group, 3), 1 / 3)).toEqual(group);
      }),
    );
  });

  test('stretched without ripple leaves what is behind it', () => {
    fc.assert(
      fc.property(anyScene, fc.integer({ min: 0, max: 30 }), ([group, range], factor) => {
        const ends = frameEnds(group.frames);
        const outside = ends.flatMap((atMs, index) =>
          atMs <= range.fromMs || atMs > range.toMs ? [index] : [],
        );
        const after = frameEnds(stretch(group, range, factor / 10, STAY).frames);
        expect(outside.map((index) => after[index])).toEqual(outside.map((index) => ends[index]));
      }),
    );
  });

  test('stretched back keeps its end and what is outside, and is pressed again as it was', () => {
    fc.assert(
      fc.property(anyScene, fc.integer({ min: 0, max: 30 }), ([group, range], factor) => {
        const ends = frameEnds(group.frames);
        const outside = ends.flatMap((atMs, index) =>
          atMs < range.fromMs || atMs >= range.toMs ? [index] : [],
        );
        const after = frameEnds(stretchBack(group, range, factor / 10).frames);
        expect(outside.map((index) => after[index])).toEqual(outside.map((index) => ends[index]));
      }),
    );
    const group = [1000, 1200, 1400, 1600].reduce(
      (before, position, index) => setKey(before, 1, [800, 1000, 1100, 1200][index]!, position),
      emptyGroup('Wave', 'us'),
    );
    const range = { fromMs: 1000, toMs: 1200 };
    const longer = stretchBack(group, range, 1.5);
    expect(frameEnds(longer.frames)).toEqual([800, 900, 1050, 1200]);
    expect(stretchBack(longer, { fromMs: 900, toMs: 1200 }, 2 / 3)).toEqual(group);
    expect(frameEnds(stretchBack(group, range, 9).frames)).toEqual([800, 800, 1000, 1200]);
  });

  test('of a frame changed there and back is as it was', () => {
    const unmarked = someGroup({ least: 1 }).map((group) => frozen({ ...group, markers: [] }));
    fc.assert(
      fc.property(unmarked, fc.nat(7), fc.nat(3000), fc.boolean(), (group, pick, durationMs, ripple) => {
        const frame = group.frames[pick % group.frames.length]!;
        const away = setDuration(group, frame.id, durationMs, { ripple });
        expect(setDuration(away, frame.id, frame.durationMs, { ripple })).toEqual(group);
        if (ripple)
          expect(totalDurationMs(away.frames) - totalDurationMs(group.frames)).toBe(
            durationMs - frame.durationMs,
          );
      }),
    );
  });

  test('reversed twice is as it was', () => {
    fc.assert(
      fc.property(anyScene, ([group, range]) => {
        expect(reverse(reverse(group, range), range)).toEqual(group);
      }),
    );
  });

  test('reversed shows the same motion from its end', () => {
    const smooth = EASINGS.filter((easing) => easing !== 'hold');
    const full = someGroup({
      ...{ servos: [1, 2], isFull: true, easings: smooth, least: 2 },
      durationMs: fc.integer({ min: 1, max: 900 }),
    });
    fc.assert(
      fc.property(full, evenly(0, 1), (group, share) => {
        const fromMs = group.frames[0]!.durationMs;
        const toMs = totalDurationMs(group.frames);
        const atMs = fromMs + share * (toMs - fromMs);
        const before = positionAt(tracksOf(group).get(1)!, atMs)!;
        const after = positionAt(tracksOf(reverse(group, { fromMs, toMs })).get(1)!, fromMs + toMs - atMs)!;
        expect(after).toBeCloseTo(before, 6);
      }),
    );
  });

  test('that is longer than a frame can be is filled with frames without keys', () => {
    const group = setKey(emptyGroup('Wave', 'us'), 1, 150_000, 1500);
    expect(group.frames.map(({ durationMs, targets }) => [durationMs, targets.length])).toEqual([
      [65_535, 0],
      [65_535, 0],
      [18_930, 1],
    ]);
  });
});
