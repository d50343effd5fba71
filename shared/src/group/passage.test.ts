import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { evenly } from '../testing/cases.ts';
import { someGroup } from '../testing/groups.ts';
import { passageOf, type PassageOptions } from './passage.ts';
import { positionAt, tracksOf } from './tracks.ts';
import type { ActionGroup } from './group.ts';

const WHOLE: PassageOptions = {
  fromMs: 0,
  toMs: null,
  speedPercent: 100,
  longestMs: 30_000,
  unknownServos: [],
  seam: { largestStep: 50, unitsPerMs: 2 },
};

const at = (durationMs: number, ...positions: readonly number[]) => ({
  durationMs,
  targets: positions.map((position, index) => ({ servo: index + 1, position })),
});

const FRAMES = [at(200, 1000, 1500), at(400, 2000, 1500), at(600, 1400, 1800)];

describe('a passage', () => {
  test('of the whole group is the group', () => {
    expect(passageOf(FRAMES, WHOLE)).toEqual({
      ...{ frames: FRAMES, loopFrom: 0, returns: false },
      ...{ atMs: [200, 600, 1200], beginMs: 0 },
    });
  });

  test('from within leads to the pose there, then goes on', () => {
    const { frames, atMs } = passageOf(FRAMES, { ...WHOLE, fromMs: 300 });
    expect(frames).toEqual([at(1500, 1250, 1500), at(300, 2000, 1500), at(600, 1400, 1800)]);
    expect(atMs).toEqual([300, 600, 1200]);
  });

  test('goes in short parts behind its lead where other moves go beside it', () => {
    const { frames, atMs } = passageOf(FRAMES, { ...WHOLE, longestPartMs: 210 });
    expect(frames).toEqual([
      ...[FRAMES[0], at(200, 1500, 1500), at(200, 2000, 1500)],
      ...[at(200, 1800, 1600), at(200, 1600, 1700), at(200, 1400, 1800)],
    ]);
    expect(atMs).toEqual([200, 400, 600, 800, 1000, 1200]);
  });

  test('ends where it is cut', () => {
    const { frames, atMs } = passageOf(FRAMES, { ...WHOLE, fromMs: 300, toMs: 900 });
    expect(frames).toEqual([at(1500, 1250, 1500), at(300, 2000, 1500), at(300, 1700, 1650)]);
    expect(atMs.at(-1)).toBe(900);
  });

  test('that ends where it begins is repeated without a way back', () => {
    const circle = [at(200, 1000), at(400, 2000), at(400, 1000)];
    const way = ({ loopFrom, returns }: ReturnType<typeof passageOf>) => [loopFrom, returns];
    expect(way(passageOf(circle, { ...WHOLE, fromMs: 400, toMs: 800 }))).toEqual([1, false]);
    expect(way(passageOf(circle, { ...WHOLE, fromMs: 400 }))).toEqual([0, true]);
    // 40 units further on, and within the soft limit there.
    expect(way(passageOf(circle, { ...WHOLE, fromMs: 416, toMs: 800 }))).toEqual([1, false]);
    expect(
      way(
        passageOf(circle, { ...WHOLE, fromMs: 416, toMs: 800, seam: { largestStep: 50, unitsPerMs: 0.1 } }),
      ),
    ).toEqual([0, true]);
  });

  test('names where its loop begins what would stay at its end', () => {
    const group = [at(200, 1000, 1500), at(400, 2000), at(400, 1000, 1540)];
    const { frames, loopFrom } = passageOf(group, { ...WHOLE, fromMs: 300, toMs: 900 });
    expect(loopFrom).toBe(1);
    expect(frames[1]).toEqual(at(300, 2000, 1500));
  });

  test('from behind its end is the whole of it', () => {
    expect(passageOf(FRAMES, { ...WHOLE, fromMs: 1200 })).toEqual(passageOf(FRAMES, WHOLE));
  });

  test('of nothing is nothing', () => {
    expect(passageOf([], WHOLE)).toEqual({ frames: [], loopFrom: 0, returns: false, atMs: [], beginMs: 0 });
  });

  test('takes frames that are too long when slowed down in parts', () => {
    const slow = passageOf([at(0, 1000), at(1000, 2000)], { ...WHOLE, speedPercent: 10, longestMs: 3000 });
    expect(slow.frames.slice(1)).toEqual([at(2500, 1250), at(2500, 1500), at(2500, 1750), at(2500, 2000)]);
    expect(slow.atMs).toEqual([0, 250, 500, 750, 1000]);
  });

  test('brings servos of unknown position to their first place at the beginning', () => {
    const late = [at(200, 1000), { durationMs: 400, targets: [{ servo: 2, position: 1700 }] }];
    expect(passageOf(late, { ...WHOLE, unknownServos: [2] }).frames[0]).toEqual(at(200, 1000, 1700));
    expect(passageOf(late, WHOLE).frames[0]).toEqual(at(200, 1000));
  });
});

/** As a board would play it: straight, from frame to frame. */
const straight = (fraction: Partial<Parameters<typeof someGroup>[0]> = {}) =>
  someGroup({ isFull: true, easings: ['linear'], least: 2, ...fraction });

const lengthOf = ({ frames }: ActionGroup): number =>
  frames.reduce((sum, { durationMs }) => sum + durationMs, 0);

describe('every passage', () => {
  test('takes exactly as long as its part of the group at its speed', () => {
    fc.assert(
      fc.property(
        straight(),
        fc.integer({ min: 10, max: 200 }),
        evenly(0, 1),
        (group, speedPercent, share) => {
          const fromMs = Math.floor(lengthOf(group) * share);
          const { frames, atMs } = passageOf(group.frames, {
            ...WHOLE,
            fromMs,
            speedPercent,
            longestMs: 700,
          });
          const tookMs = frames.slice(1).reduce((sum, { durationMs }) => sum + durationMs, 0);
          const partMs = (atMs.at(-1) ?? 0) - (atMs[0] ?? 0);
          expect(tookMs).toBe(Math.round((partMs * 100) / speedPercent));
          expect(frames.slice(1).every(({ durationMs }) => durationMs <= 700)).toBe(true);
        },
      ),
    );
  });

  test('goes where the group goes', () => {
    fc.assert(
      fc.property(
        straight({ durationMs: fc.integer({ min: 20, max: 1500 }) }),
        fc.integer({ min: 10, max: 200 }),
        evenly(0, 1),
        (group, speedPercent, share) => {
          const tracks = tracksOf(group);
          const fromMs = Math.floor(lengthOf(group) * share);
          const { frames, atMs } = passageOf(group.frames, {
            ...WHOLE,
            fromMs,
            speedPercent,
            longestMs: 700,
          });
          for (const [index, { targets }] of frames.entries()) {
            for (const { servo, position } of targets) {
              const there = positionAt(tracks.get(servo)!, atMs[index]!);
              expect(Math.abs(position - (there ?? NaN))).toBeLessThanOrEqual(1);
            }
          }
        },
      ),
    );
  });
});
