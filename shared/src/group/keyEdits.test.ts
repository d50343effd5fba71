import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { Easing } from './curves.ts';
import { emptyGroup, totalDurationMs, type ActionGroup } from './group.ts';
import { insertFrame } from './groupEdits.ts';
import { refsOf, shapeOf, someGroup, someRefs, withGroup } from '../testing/groups.ts';
import {
  boundedMove,
  deleteKeys,
  moveKeys,
  scaleAmplitude,
  setEasing,
  setKey,
  smoothKeys,
  stagger,
} from './keyEdits.ts';
import { setDuration } from './timeEdits.ts';
import { frameEnds, keysAt, positionAt, tracksOf, type KeyRef } from './tracks.ts';

const SERVOS = [1, 2, 3, 4, 5, 6];
const STAY = { ripple: false };
const RIPPLE = { ripple: true };

/** In the order of servos and times. */
function easingsOf(group: ActionGroup, refs: readonly KeyRef[]): readonly Easing[] {
  const names = new Set(refs.map(({ frameId, servo }) => `${frameId} ${servo}`));
  const keys = [...tracksOf(group).values()].flatMap((track) => track.keys);
  return keys.filter(({ frameId, servo }) => names.has(`${frameId} ${servo}`)).map(({ easing }) => easing);
}

describe('a key', () => {
  test('set at any time is there, and the frame it is cut from gives its easing', () => {
    fc.assert(
      fc.property(someGroup(), fc.constantFrom(...SERVOS), fc.nat(200_000), (group, servo, atMs) => {
        const after = setKey(group, servo, atMs, 1234);
        expect(positionAt(tracksOf(after).get(servo)!, atMs)).toBe(1234);
      }),
    );
    const eased = insertFrame(emptyGroup('Wave', 'us'), 0, {
      durationMs: 1000,
      targets: [{ servo: 1, position: 1500 }],
      easing: 'out',
    });
    expect(setKey(eased, 2, 400, 900).frames.map(({ easing }) => easing)).toEqual(['out', 'out']);
  });

  test('moved there and back is where it was', () => {
    const spaced = someGroup({ durationMs: fc.integer({ min: 1, max: 900 }), least: 1 });
    const moves = fc.record({
      deltaMs: fc.integer({ min: -800, max: 2000 }),
      deltaPosition: fc.integer({ min: -400, max: 400 }),
    });
    fc.assert(
      fc.property(withGroup(spaced, someRefs), moves, ([group, refs], wanted) => {
        const keys = [...tracksOf(group).values()].flatMap((track) => track.keys);
        const times = new Set(frameEnds(group.frames));
        const chosen = keys.filter((key) =>
          refs.some((ref) => ref.frameId === key.frameId && ref.servo === key.servo),
        );
        const move = boundedMove(chosen, wanted);
        const there = chosen.map(({ servo, atMs }) => ({ servo, atMs: atMs + move.deltaMs }));
        fc.pre(move.deltaMs === 0 || there.every(({ atMs }) => !times.has(atMs)));
        const away = moveKeys(group, refs, move, STAY);
        const found = keysAt(tracksOf(away), there);
        expect(found).toHaveLength(refs.length);
        expect(easingsOf(away, found)).toEqual(easingsOf(group, refs));
        const back = { deltaMs: -move.deltaMs, deltaPosition: -move.deltaPosition };
        expect(shapeOf(moveKeys(away, found, back, STAY))).toEqual(shapeOf(group));
      }),
    );
  });

  test('moved onto another of its servo takes its place', () => {
    const group = [1000, 2000, 1500].reduce(
      (sum, position, index) =>
        insertFrame(sum, index, { durationMs: 100, targets: [{ servo: 1, position }] }),
      emptyGroup('Wave', 'us'),
    );
    const moved = moveKeys(group, [{ frameId: 1, servo: 1 }], { deltaMs: 100, deltaPosition: 7 }, STAY);
    expect(shapeOf(moved)[0]!.keys.map(({ atMs, position }) => [atMs, position])).toEqual([
      [200, 1007],
      [300, 1500],
    ]);
  });

  test('goes with its frame, which keeps its name when all its keys move', () => {
    const pose = { durationMs: 500, targets: [1, 2].map((servo) => ({ servo, position: 1500 })) };
    const group = insertFrame(insertFrame(emptyGroup('Wave', 'us'), 0, pose), 1, pose);
    const moved = moveKeys(
      group,
      refsOf(group).filter(({ frameId }) => frameId === 2),
      { deltaMs: -300, deltaPosition: 0 },
      STAY,
    );
    expect(moved.frames.map(({ id, durationMs }) => [id, durationMs])).toEqual([
      [1, 500],
      [2, 200],
    ]);
  });

  test.each([
    ['', null, 1],
    ['Wait for it', null, 2],
    ['', 'plum', 2],
  ] as const)('gone, its frame with note "%s" and colour %s is one of %i left', (note, colour, left) => {
    const frame = { durationMs: 500, targets: [{ servo: 1, position: 1500 }] };
    const pair = insertFrame(insertFrame(emptyGroup('Wave', 'us'), 0, { ...frame, note, colour }), 1, frame);
    const group = deleteKeys(pair, [{ frameId: 1, servo: 1 }], STAY);
    expect(group.frames).toHaveLength(left);
    expect(totalDurationMs(group.frames)).toBe(1000);
  });

  test('is as far from the middle as the factor says, and so back', () => {
    const even = someGroup({ positions: fc.integer({ min: 0, max: 500 }).map((half) => 2 * half), least: 1 });
    const about = new Map(SERVOS.map((servo) => [servo, 1000]));
    fc.assert(
      fc.property(even, (group) => {
        const refs = refsOf(group);
        const half = scaleAmplitude(group, refs, 0.5, about);
        const position = (one: ActionGroup) =>
          one.frames.flatMap(({ targets }) => targets.map((target) => target.position));
        expect(position(half)).toEqual(position(group).map((at) => (at + 1000) / 2));
        expect(scaleAmplitude(half, refs, 2, about)).toEqual(group);
      }),
    );
  });
});

describe('with ripple', () => {
  test('frames that lose all their keys go with their time, and what is behind comes so much sooner', () => {
    fc.assert(
      fc.property(withGroup(someGroup(), someRefs), ([group, refs]) => {
        const stayed = deleteKeys(group, refs, STAY);
        const ids = new Set(stayed.frames.map(({ id }) => id));
        const left = group.frames.filter(({ id }) => ids.has(id));
        const closed = deleteKeys(group, refs, RIPPLE);
        expect(closed.frames.map(({ id, durationMs }) => [id, durationMs])).toEqual(
          left.map(({ id, durationMs }) => [id, durationMs]),
        );
        expect(closed.frames.map(({ targets }) => targets)).toEqual(
          stayed.frames.map(({ targets }) => targets),
        );
      }),
    );
  });

  test('markers go along as they would if each frame went alone', () => {
    fc.assert(
      fc.property(withGroup(someGroup(), someRefs), ([group, refs]) => {
        const left = new Set(deleteKeys(group, refs, STAY).frames.map(({ id }) => id));
        const alone = group.frames
          .filter(({ id }) => !left.has(id))
          .reduce((sum, { id }) => setDuration(sum, id, 0, RIPPLE), group);
        expect(deleteKeys(group, refs, RIPPLE).markers).toEqual(alone.markers);
      }),
    );
  });

  test('everything behind the earliest key goes along', () => {
    fc.assert(
      fc.property(
        withGroup(someGroup(), someRefs),
        fc.integer({ min: 0, max: 900 }),
        ([group, refs], deltaMs) => {
          const ends = new Map(group.frames.map(({ id }, index) => [id, index]));
          const first = Math.min(...refs.map(({ frameId }) => ends.get(frameId)!));
          const moved = moveKeys(group, refs, { deltaMs, deltaPosition: 0 }, RIPPLE);
          expect(moved.frames.map(({ durationMs }) => durationMs)).toEqual(
            group.frames.map(({ durationMs }, index) => durationMs + (index === first ? deltaMs : 0)),
          );
        },
      ),
    );
  });
});

describe('servos that begin one after another', () => {
  const spaced = someGroup({ durationMs: fc.integer({ min: 1, max: 900 }), easings: ['linear'] });

  test('do the same as before, each so much later, and stay at their first keys until then', () => {
    fc.assert(
      fc.property(spaced, fc.integer({ min: 1, max: 300 }), fc.subarray(SERVOS), (group, stepMs, free) => {
        const [before, after] = [group, stagger(group, stepMs, (servo) => free.includes(servo))].map((one) =>
          tracksOf(one),
        );
        let delayMs = 0;
        for (const [servo, track] of before!) {
          const first = track.keys[0]!;
          const last = track.keys.at(-1)!;
          const isMoved =
            free.includes(servo) && track.keys.some(({ position }) => position !== first.position);
          const byMs = isMoved ? delayMs : 0;
          if (isMoved) delayMs += stepMs;
          const later = after!.get(servo)!;
          for (const share of [0, 0.2, 0.5, 0.9, 1]) {
            const atMs = first.atMs + (last.atMs - first.atMs) * share;
            expect(positionAt(later, atMs + byMs)).toBeCloseTo(positionAt(track, atMs)!, 6);
            expect(positionAt(later, first.atMs + byMs * share)).toBeCloseTo(first.position, 6);
          }
        }
      }),
    );
  });

  test('with no time between them nothing changes', () => {
    fc.assert(
      fc.property(someGroup(), (group) => {
        expect(stagger(group, 0, () => true)).toBe(group);
        expect(stagger(group, 50, () => false)).toBe(group);
      }),
    );
  });
});

describe('how keys are come to', () => {
  const base = [
    [1000, { 1: 1000, 2: 1000 }],
    [1000, { 1: 1500, 2: 1500 }],
    [1000, { 1: 2000, 2: 1000 }],
  ] as const;
  const OVERSHOOT = [0.34, 1.56, 0.64, 1] as const;
  type Row = readonly [durationMs: number, positions: Readonly<Record<number, number>>];
  const groupOf = (...rows: readonly Row[]): ActionGroup =>
    rows.reduce<ActionGroup>(
      (group, [durationMs, positions], index) =>
        insertFrame(group, index, {
          durationMs,
          targets: Object.entries(positions).map(([servo, position]) => ({ servo: Number(servo), position })),
        }),
      emptyGroup('Wave', 'us'),
    );
  const into = (group: ActionGroup, servo: number) =>
    tracksOf(group)
      .get(servo)
      ?.keys.map(({ easing }) => easing);

  test('changes for one servo alone, and the frame says what all of its keys share', () => {
    const group = groupOf(...base);
    const one = setEasing(group, [{ frameId: 2, servo: 1 }], OVERSHOOT);
    expect(into(one, 1)).toEqual(['linear', OVERSHOOT, 'linear']);
    expect(into(one, 2)).toEqual(['linear', 'linear', 'linear']);
    const both = setEasing(one, [{ frameId: 2, servo: 2 }], OVERSHOOT);
    expect(both.frames[1]).toMatchObject({ easing: OVERSHOOT, targets: [{ servo: 1 }, { servo: 2 }] });
    expect(both.frames[1]?.targets.some((target) => 'easing' in target)).toBe(false);
    expect(setEasing(one, [{ frameId: 2, servo: 1 }], [...OVERSHOOT])).toBe(one);
    expect(setEasing(one, [{ frameId: 2, servo: 1 }], 'linear')).toEqual(group);
  });

  test('goes along with a key that comes to a frame of another easing', () => {
    const group = setEasing(groupOf(...base), [{ frameId: 2, servo: 1 }], OVERSHOOT);
    const moved = moveKeys(
      group,
      [{ frameId: 2, servo: 1 }],
      { deltaMs: 1000, deltaPosition: 0 },
      { ripple: false },
    );
    expect(into(moved, 1)).toEqual(['linear', OVERSHOOT]);
    expect(into(setKey(moved, 1, 3000, 1200), 1)).toEqual(['linear', OVERSHOOT]);
  });

  test('smoothed: passes at one speed, and never beyond a key', () => {
    const positions = fc.array(fc.integer({ min: 500, max: 2500 }), { minLength: 2, maxLength: 6 });
    fc.assert(
      fc.property(positions, fc.integer({ min: 20, max: 2000 }), (places, stepMs) => {
        const group = groupOf(...places.map((at, index) => [stepMs * (index + 1), { 1: at }] as const));
        const track = tracksOf(smoothKeys(group, refsOf(group))).get(1)!;
        for (const [index, key] of track.keys.entries()) {
          const next = track.keys[index + 1];
          if (next === undefined) continue;
          for (let share = 0; share <= 1; share += 0.05) {
            const at = positionAt(track, key.atMs + share * (next.atMs - key.atMs))!;
            expect(at).toBeGreaterThanOrEqual(Math.min(key.position, next.position) - 1e-6);
            expect(at).toBeLessThanOrEqual(Math.max(key.position, next.position) + 1e-6);
          }
        }
      }),
    );
    const straight = smoothKeys(groupOf([1000, { 1: 1000 }], [1000, { 1: 1500 }], [1000, { 1: 2000 }]), [
      { frameId: 2, servo: 1 },
    ]);
    const track = tracksOf(straight).get(1)!;
    const speedAt = (atMs: number) => positionAt(track, atMs + 1)! - positionAt(track, atMs - 1)!;
    expect(speedAt(1990)).toBeCloseTo(speedAt(2010), 1);
  });
});
