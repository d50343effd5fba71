import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { evenly } from '../testing/cases.ts';
import {
  arePlacedAlike,
  frameEnds,
  keyIn,
  keysAt,
  poseAtMs,
  positionAt,
  repositioned,
  tracksOf,
} from './tracks.ts';
import { handlesOf, type Easing } from './curves.ts';
import { easingOf, emptyGroup, totalDurationMs } from './group.ts';
import { insertFrame, setTargets } from './groupEdits.ts';
import { setDuration } from './timeEdits.ts';
import { ANY_EASING, someGroup } from '../testing/groups.ts';
import { setEasing, setPositions } from './keyEdits.ts';

type Row = readonly [durationMs: number, targets: Readonly<Record<number, number>>, easing?: Easing];

function groupOf(...rows: readonly Row[]) {
  return rows.reduce(
    (group, [durationMs, positions, easing = 'linear']) => {
      const targets = Object.entries(positions).map(([servo, position]) => ({
        servo: Number(servo),
        position,
      }));
      return insertFrame(group, group.frames.length, { durationMs, targets, easing });
    },
    emptyGroup('Wave', 'us'),
  );
}

const shares = evenly(0, 1);

/** Curves that swing past no end. */
const INSIDE = ANY_EASING.filter((easing) => {
  const [, y1 = 0, , y2 = 0] = handlesOf(easing) ?? [];
  return Math.min(y1, y2) >= 0 && Math.max(y1, y2) <= 1;
});
const durationMs = fc.integer({ min: 1, max: 900 });

describe('a servo between its keys', () => {
  test('is unknown before its first key, unless its start is known', () => {
    const track = tracksOf(groupOf([1000, { 1: 2000 }])).get(1)!;
    expect([positionAt(track, 0), positionAt(track, 999), positionAt(track, 1000)]).toEqual([
      null,
      null,
      2000,
    ]);
    expect([positionAt(track, 0, 1000), positionAt(track, 250, 1000)]).toEqual([1000, 1250]);
  });

  test('goes on towards its next key through frames that do not name it', () => {
    const tracks = tracksOf(groupOf([0, { 1: 1000, 2: 500 }], [400, { 2: 700 }], [600, { 1: 2000 }]));
    expect([0, 400, 500, 1000, 9000].map((atMs) => positionAt(tracks.get(1)!, atMs))).toEqual([
      1000, 1400, 1500, 2000, 2000,
    ]);
    expect(positionAt(tracks.get(2)!, 200)).toBe(600);
  });

  test('comes in by the easing of the frame that has its key', () => {
    const tracks = tracksOf(groupOf([0, { 1: 1000 }], [500, { 2: 1 }, 'out'], [500, { 1: 2000 }, 'in']));
    expect(positionAt(tracks.get(1)!, 500)).toBe(1250);
  });

  test('that holds stays, then jumps', () => {
    const track = tracksOf(groupOf([0, { 1: 1000 }], [500, { 1: 2000 }, 'hold'])).get(1)!;
    expect([positionAt(track, 499), positionAt(track, 500)]).toEqual([1000, 2000]);
  });

  test('with two keys at one instant is at the later one', () => {
    const track = tracksOf(groupOf([100, { 1: 1000 }], [0, { 1: 2000 }], [100, { 1: 1000 }])).get(1)!;
    expect([positionAt(track, 100), positionAt(track, 150)]).toEqual([2000, 1500]);
  });

  test('is at each key when it is due, and never outside of two keys between them', () => {
    fc.assert(
      fc.property(someGroup({ durationMs, easings: INSIDE }), shares, (group, share) => {
        for (const track of tracksOf(group).values()) {
          for (const [index, key] of track.keys.entries()) {
            expect(positionAt(track, key.atMs)).toBe(key.position);
            const next = track.keys[index + 1] ?? key;
            const between = positionAt(track, key.atMs + share * (next.atMs - key.atMs))!;
            expect(between).toBeGreaterThanOrEqual(Math.min(key.position, next.position));
            expect(between).toBeLessThanOrEqual(Math.max(key.position, next.position));
          }
        }
      }),
    );
  });
});

describe('the tracks of a group', () => {
  test('have every key once, at the end of its frame, in servo order', () => {
    fc.assert(
      fc.property(someGroup(), (group) => {
        const ends = frameEnds(group.frames);
        const tracks = tracksOf(group);
        const keys = group.frames.flatMap((frame, index) =>
          frame.targets.map((target) => ({
            ...{ ...target, easing: easingOf(target, frame) },
            ...{ frameId: frame.id, atMs: ends[index]! },
          })),
        );
        const servos = [...tracks.keys()];
        expect(servos).toEqual(servos.toSorted((one, other) => one - other));
        expect([...tracks.values()].flatMap((track) => track.keys)).toEqual(
          keys.toSorted((one, other) => one.servo - other.servo),
        );
        expect(ends.at(-1) ?? 0).toBe(totalDurationMs(group.frames));
      }),
    );
  });

  test('stay the same object for a servo that an edit leaves alone', () => {
    const group = groupOf([100, { 1: 1000, 2: 1000 }], [100, { 1: 2000, 2: 2000 }]);
    const before = tracksOf(group);
    const turned = setTargets(group, 2, [
      { servo: 1, position: 1500 },
      { servo: 2, position: 2000 },
    ]);
    const after = tracksOf(turned, before);
    expect(after.get(2)).toBe(before.get(2));
    expect(after.get(1)).not.toBe(before.get(1));
    for (const edited of [
      setDuration(group, 2, 300, { ripple: true }),
      setEasing(group, [{ frameId: 2, servo: 2 }], 'in'),
    ])
      expect(tracksOf(edited, before).get(2)).not.toBe(before.get(2));
  });

  test('tell the whole pose, with the servos that only stand there', () => {
    const tracks = tracksOf(groupOf([100, { 1: 1000 }], [100, { 2: 2000 }]));
    expect([
      ...poseAtMs(
        tracks,
        150,
        new Map([
          [2, 1000],
          [9, 700],
        ]),
      ),
    ]).toEqual([
      [2, 1750],
      [9, 700],
      [1, 1000],
    ]);
    expect([...poseAtMs(tracks, 150)]).toEqual([[1, 1000]]);
  });

  test('find keys by servo and time', () => {
    const tracks = tracksOf(groupOf([100, { 1: 1000 }], [100, { 2: 2000 }]));
    const wanted = [
      { servo: 2, atMs: 200 },
      { servo: 2, atMs: 100 },
      { servo: 3, atMs: 100 },
    ];
    expect(keysAt(tracks, wanted)).toEqual([{ frameId: 2, servo: 2 }]);
  });

  test('find the key in a frame, also where frames end at the same time', () => {
    const tracks = tracksOf(groupOf([100, { 1: 1000 }], [0, { 1: 1100, 2: 2000 }]));
    expect(keyIn(tracks, { frameId: 1, servo: 1 }, 100)?.position).toBe(1000);
    expect(keyIn(tracks, { frameId: 2, servo: 1 }, 100)?.position).toBe(1100);
    expect(keyIn(tracks, { frameId: 1, servo: 2 }, 100)).toBeUndefined();
    expect(keyIn(tracks, { frameId: 3, servo: 1 }, 100)).toBeUndefined();
  });
});

describe('after a few keys got other positions', () => {
  const changes = fc.array(fc.record({ key: fc.nat(), position: fc.integer({ min: 500, max: 2500 }) }), {
    maxLength: 4,
  });

  test('the tracks are those of the frames, and the keys of the other servos are the very same', () => {
    fc.assert(
      fc.property(someGroup({ least: 1 }), changes, (before, wanted) => {
        const tracks = tracksOf(before);
        const keys = [...tracks.values()].flatMap((track) => track.keys);
        const named = wanted.flatMap(({ key, position }) => {
          const found = keys[key % Math.max(1, keys.length)];
          return found === undefined ? [] : [{ ...found, position }];
        });
        const after = setPositions(before, named);
        const from = { frames: before.frames, ends: frameEnds(before.frames), tracks };
        const changed = repositioned(after.frames, from);
        expect(arePlacedAlike(before.frames, after.frames)).toBe(true);
        expect(changed).toEqual(tracksOf(after));
        for (const [servo, track] of tracks)
          if (named.every((key) => key.servo !== servo)) expect(changed?.get(servo)).toBe(track);
      }),
    );
  });

  test('another duration, another easing, another servo are not only that', () => {
    const before = groupOf([1000, { 1: 1500, 2: 1500 }], [500, { 1: 1600 }]);
    const id = before.frames[1]?.id ?? 0;
    for (const after of [
      setDuration(before, id, 700, { ripple: true }),
      setEasing(before, [{ frameId: id, servo: 1 }], 'out'),
      setTargets(before, id, [{ servo: 2, position: 1600 }]),
      insertFrame(before, 2, { durationMs: 100, targets: [{ servo: 1, position: 1600 }] }),
    ])
      expect(arePlacedAlike(before.frames, after.frames)).toBe(false);
  });
});
