import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { emptyGroup, type ActionGroup } from './group.ts';
import { refsOf, shapeOf, someGroup, someRefs, withGroup } from '../testing/groups.ts';
import { insertFrame } from './groupEdits.ts';
import { addMarker } from './frameEdits.ts';
import { reverseKeys } from './keyRanges.ts';
import { reverse } from './timeEdits.ts';
import { keysAt, tracksOf, type Key, type KeyRef } from './tracks.ts';

const durationMs = fc.integer({ min: 1, max: 900 });
const spaced = someGroup({ durationMs });
const scene = withGroup(spaced, someRefs);

function keysOf(group: ActionGroup, refs: readonly KeyRef[]) {
  const chosen = new Set(refs.map(({ frameId, servo }) => `${frameId}/${servo}`));
  const all = [...tracksOf(group).values()].flatMap(({ keys }) => keys);
  const isChosen = ({ frameId, servo }: KeyRef): boolean => chosen.has(`${frameId}/${servo}`);
  return { chosen: all.filter(isChosen), others: all.filter((key) => !isChosen(key)) };
}

function spanOf(keys: readonly Key[]) {
  const times = keys.map(({ atMs }) => atMs);
  return { fromMs: Math.min(...times), toMs: Math.max(...times) };
}

/** The chosen keys where they are to be. */
function mirrored(keys: readonly Key[]): readonly Key[] {
  const { fromMs, toMs } = spanOf(keys);
  return keys.map((key) => ({ ...key, atMs: fromMs + toMs - key.atMs }));
}

const placeOf = ({ servo, atMs, position }: Pick<Key, 'servo' | 'atMs' | 'position'>) =>
  `servo ${servo} at ${atMs}: ${position}`;
const placesIn = (group: ActionGroup): readonly string[] => keysOf(group, []).others.map(placeOf).sort();

/** There and back: the keys are named anew on the way. */
function reversedTwice(group: ActionGroup, refs: readonly KeyRef[]): ActionGroup {
  const once = reverseKeys(group, refs);
  return reverseKeys(once, keysAt(tracksOf(once), mirrored(keysOf(group, refs).chosen)));
}

const inRows = (...rows: readonly (readonly (number | null)[])[]): ActionGroup =>
  rows.reduce<ActionGroup>(
    (group, positions, index) =>
      insertFrame(group, index, {
        durationMs: 500,
        targets: positions.flatMap((position, at) =>
          position === null ? [] : [{ servo: at + 1, position }],
        ),
      }),
    emptyGroup('Wave', 'us'),
  );

describe('reversed keys', () => {
  test('are at the mirrored time of their own row, none is lost, and every other key stays where it is', () => {
    fc.assert(
      fc.property(scene, ([group, refs]) => {
        const { chosen, others } = keysOf(group, refs);
        const after = reverseKeys(group, refs);
        expect(placesIn(after)).toEqual([...mirrored(chosen), ...others].map(placeOf).sort());
        expect(refsOf(after)).toHaveLength(refsOf(group).length);
      }),
    );
  });

  test('reversed again are where they were', () => {
    fc.assert(
      fc.property(scene, ([group, refs]) => {
        expect(placesIn(reversedTwice(group, refs))).toEqual(placesIn(group));
      }),
    );
  });

  test('reversed again come in as they did, where all come in alike', () => {
    const alike = someGroup({ durationMs, easings: ['inOut'] });
    fc.assert(
      fc.property(withGroup(alike, someRefs), ([group, refs]) => {
        expect(shapeOf(reversedTwice(group, refs))).toEqual(shapeOf(group));
      }),
    );
  });

  test('the keys of other rows and other times come in as they did', () => {
    fc.assert(
      fc.property(scene, ([group, refs]) => {
        const servos = new Set(refs.map(({ servo }) => servo));
        const others = (one: ActionGroup) => shapeOf(one).filter(({ servo }) => !servos.has(servo));
        expect(others(reverseKeys(group, refs))).toEqual(others(group));
      }),
    );
  });

  test('of all rows are reversed as the time from the first to the last of them is', () => {
    fc.assert(
      fc.property(someGroup(), (group) => {
        const { chosen } = keysOf(group, refsOf(group));
        if (chosen.length === 0) return;
        const wanted = reverse(group, spanOf(chosen));
        const after = reverseKeys(group, refsOf(group));
        expect(after).toEqual(wanted);
        expect(after === group).toBe(wanted === group);
      }),
    );
  });

  test('of one row leave the rows beside it, and the markers', () => {
    const group = addMarker(inRows([1, 11], [2, 12], [3, 13]), 500, 'Here');
    const after = reverseKeys(
      group,
      refsOf(group).filter(({ servo }) => servo === 1),
    );
    expect(after.frames.map(({ targets }) => targets.map(({ position }) => position))).toEqual([
      [3, 11],
      [2, 12],
      [1, 13],
    ]);
    expect(after.markers).toBe(group.markers);
  });

  test('of whole frames apart change places, and what is between stays', () => {
    const group = inRows([1, 11], [2, 12], [3, 13]);
    const after = reverseKeys(
      group,
      refsOf(group).filter(({ frameId }) => frameId !== 2),
    );
    expect(after.frames.map(({ id, targets }) => [id, ...targets.map(({ position }) => position)])).toEqual([
      [3, 3, 13],
      [2, 2, 12],
      [1, 1, 11],
    ]);
  });

  test('none, or all at one instant: nothing changes', () => {
    fc.assert(
      fc.property(spaced, fc.nat(7), (group, pick) => {
        const frame = group.frames[pick % Math.max(1, group.frames.length)];
        const some = refsOf(group).filter(({ frameId }) => frameId === frame?.id);
        expect(reverseKeys(group, [])).toBe(group);
        expect(reverseKeys(group, some)).toBe(group);
        expect(reverseKeys(group, some.slice(1))).toBe(group);
      }),
    );
  });
});
