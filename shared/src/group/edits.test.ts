// Every edit of a group by what all of them promise: whole afterwards, nothing changed in place, other servos as they were.

import { isDeepStrictEqual } from 'node:util';
import fc from 'fast-check';
import { safeParse } from 'valibot';
import { describe, expect, test } from 'vitest';
import { copyKeys, duplicateKeys, pasteKeys } from './clip.ts';
import {
  mirror,
  setColour,
  setNote,
  addMarker,
  deleteMarker,
  moveMarker,
  renameMarker,
} from './frameEdits.ts';
import { flawOfGroup, groupSchema, type ActionGroup } from './group.ts';
import { setMeta } from './groupEdits.ts';
import { sampled, someGroup, someRange, someRefs, withGroup } from '../testing/groups.ts';
import {
  deleteKeys,
  moveKeys,
  scaleAmplitude,
  setEasing,
  setKey,
  setPositions,
  smoothKeys,
} from './keyEdits.ts';
import { reverseKeys } from './keyRanges.ts';
import {
  deleteTime,
  insertTime,
  moveBoundary,
  reverse,
  scaleTime,
  setDuration,
  stretch,
} from './timeEdits.ts';
import { tracksOf, type KeyRef } from './tracks.ts';
import { readyRobot, type RobotNames } from '../profile/readyRobots.ts';

const NAMES: RobotNames = { robot: 'Mine', role: (role, servo) => `${role} ${servo}`, limb: (limb) => limb };
const HUMANOID = readyRobot('humanoid16', 'lsc-16', NAMES);
const SERVOS = [1, 2, 3, 4, 5, 6];
const STAY = { ripple: false };
const RIPPLE = { ripple: true };
const OVERSHOOT = [0.34, 1.56, 0.64, 1] as const;

interface Chance {
  readonly refs: readonly KeyRef[];
  readonly frameId: number;
  readonly servo: number;
  readonly fromMs: number;
  readonly toMs: number;
  readonly delta: number;
  readonly factor: number;
  readonly ripple: boolean;
}

type Edit = (group: ActionGroup, chance: Chance) => ActionGroup;

/** Only the servos of `refs`, or `servo`, may move otherwise than before. */
const KEY_EDITS: Readonly<Record<string, Edit>> = {
  setKey: (group, { servo, fromMs, delta }) => setKey(group, servo, fromMs, delta),
  moveKeys: (group, { refs, delta, factor }) =>
    moveKeys(group, refs, { deltaMs: delta, deltaPosition: factor * delta }, STAY),
  reverseKeys: (group, { refs }) => reverseKeys(group, refs),
  setPositions: (group, { refs, delta }) =>
    setPositions(
      group,
      refs.map((ref) => ({ ...ref, position: delta })),
    ),
  setEasing: (group, { refs, ripple }) => setEasing(group, refs, ripple ? 'inOut' : OVERSHOOT),
  smoothKeys: (group, { refs }) => smoothKeys(group, refs),
  deleteKeys: (group, { refs }) => deleteKeys(group, refs, STAY),
  scaleAmplitude: (group, { refs, factor }) => scaleAmplitude(group, refs, factor, 'mean'),
  pasteKeys: (group, { refs, fromMs }) => pasteKeys(group, copyKeys(group, refs), fromMs, STAY).group,
  duplicateKeys: (group, { refs, delta }) => duplicateKeys(group, refs, delta, STAY).group,
};

const OTHER_EDITS: Readonly<Record<string, Edit>> = {
  'moveKeys with ripple': (group, { refs, delta }) =>
    moveKeys(group, refs, { deltaMs: delta, deltaPosition: delta }, RIPPLE),
  'deleteKeys with ripple': (group, { refs }) => deleteKeys(group, refs, RIPPLE),
  'pasteKeys with ripple': (group, { refs, fromMs }) =>
    pasteKeys(group, copyKeys(group, refs), fromMs, RIPPLE).group,
  moveBoundary: (group, { frameId, delta, ripple }) => moveBoundary(group, frameId, delta, { ripple }),
  setDuration: (group, { frameId, delta, ripple }) =>
    setDuration(group, frameId, 100 * Math.abs(delta), { ripple }),
  insertTime: (group, { fromMs, toMs }) => insertTime(group, fromMs, 20 * toMs),
  deleteTime: (group, { fromMs, toMs }) => deleteTime(group, { fromMs, toMs }),
  stretch: (group, { fromMs, toMs, factor, ripple }) => stretch(group, { fromMs, toMs }, factor, { ripple }),
  scaleTime: (group, { factor }) => scaleTime(group, factor),
  reverse: (group, { fromMs, toMs }) => reverse(group, { fromMs, toMs }),
  setNote: (group, { frameId }) => setNote(group, frameId, 'A note'),
  setColour: (group, { frameId }) => setColour(group, [frameId, frameId + 1], 'plum'),
  mirror: (group, { frameId }) => mirror(group, HUMANOID, [frameId, frameId + 1]).group,
  addMarker: (group, { fromMs }) => addMarker(group, fromMs, 'Here'),
  moveMarker: (group, { toMs }) => moveMarker(group, group.markers[0]?.id ?? 0, toMs),
  renameMarker: (group) => renameMarker(group, group.markers[0]?.id ?? 0, 'There'),
  deleteMarker: (group) => deleteMarker(group, group.markers[0]?.id ?? 0),
  setMeta: (group) => setMeta(group, { name: 'Bow', tags: ['dance'], slot: 3, times: 2, robot: 'Mine' }),
};

const scene = withGroup(someGroup(), (group) =>
  fc.record({
    refs: someRefs(group),
    frameId: fc.integer({ min: 1, max: group.frames.length + 1 }),
    servo: fc.constantFrom(...SERVOS),
    range: someRange(group),
    delta: fc.integer({ min: -3000, max: 3000 }),
    factor: fc.integer({ min: 0, max: 30 }).map((tenths) => tenths / 10),
    ripple: fc.boolean(),
  }),
).map(([group, { range, ...rest }]) => ({ group, chance: { ...rest, ...range } }));

describe.each(Object.entries({ ...KEY_EDITS, ...OTHER_EDITS }))('%s', (_, edit) => {
  test('leaves the group whole and the one before untouched', () => {
    let changes = 0;
    fc.assert(
      fc.property(scene, ({ group, chance }) => {
        const after = edit(group, chance);
        expect(flawOfGroup(after)).toBeNull();
        expect(safeParse(groupSchema, after).issues).toBeUndefined();
        changes += after === group ? 0 : 1;
      }),
    );
    expect(changes).toBeGreaterThan(0);
  });

  test('that changes nothing returns the very same group', () => {
    fc.assert(
      fc.property(scene, ({ group, chance }) => {
        const after = edit(group, chance);
        if (after !== group) expect(after).not.toEqual(group);
      }),
    );
  });

  test('keeps the frames it does not change', () => {
    fc.assert(
      fc.property(scene, ({ group, chance }) => {
        const { frames } = edit(group, chance);
        const equals = frames.map(
          (frame) => group.frames.find((old) => isDeepStrictEqual(old, frame)) ?? frame,
        );
        expect(frames.every((frame, index) => frame === equals[index])).toBe(true);
      }),
    );
  });
});

describe.each(Object.entries(KEY_EDITS))('%s', (_, edit) => {
  test('leaves servos that it does not name exactly as they were', () => {
    fc.assert(
      fc.property(scene, ({ group, chance }) => {
        const named = new Set([chance.servo, ...chance.refs.map(({ servo }) => servo)]);
        const others = SERVOS.filter((servo) => !named.has(servo));
        const after = edit(group, chance);
        expect(sampled(tracksOf(after), others)).toEqual(sampled(tracksOf(group), others));
      }),
    );
  });
});
