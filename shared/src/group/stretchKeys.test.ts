import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { ActionGroup } from './group.ts';
import { refsOf, shapeOf, someGroup, someRefs, withGroup } from '../testing/groups.ts';
import { boundedFactor, stretchedMs, stretchKeys, type KeyStretch } from './keyRanges.ts';
import { stretch, stretchBack } from './timeEdits.ts';
import { frameEnds, tracksOf, type Key, type KeyRef } from './tracks.ts';

const spaced = someGroup({ durationMs: fc.integer({ min: 1, max: 900 }) });
const scene = withGroup(spaced, someRefs);
const someStretch = fc.record({
  tenths: fc.integer({ min: 0, max: 30 }),
  fixed: fc.constantFrom<KeyStretch['fixed']>('first', 'last'),
});

function keysOf(group: ActionGroup, refs: readonly KeyRef[]) {
  const chosen = new Set(refs.map(({ frameId, servo }) => `${frameId}/${servo}`));
  const all = [...tracksOf(group).values()].flatMap(({ keys }) => keys);
  const isChosen = ({ frameId, servo }: KeyRef): boolean => chosen.has(`${frameId}/${servo}`);
  return { chosen: all.filter(isChosen), others: all.filter((key) => !isChosen(key)) };
}

const spanOf = (times: readonly number[]) => ({ fromMs: Math.min(...times), toMs: Math.max(...times) });
const placeOf = ({ servo, atMs, position }: Pick<Key, 'servo' | 'atMs' | 'position'>) =>
  `servo ${servo} at ${atMs}: ${position}`;
const placesIn = (group: ActionGroup): readonly string[] => keysOf(group, []).others.map(placeOf).sort();

describe('stretched keys', () => {
  test('are at their share of the new length, and every other key stays where it is', () => {
    fc.assert(
      fc.property(scene, someStretch, ([group, refs], { tenths, fixed }) => {
        const { chosen, others } = keysOf(group, refs);
        if (chosen.length === 0) return;
        const span = spanOf(chosen.map(({ atMs }) => atMs));
        const wanted = { ...span, factor: tenths / 10, fixed, ripple: false };
        const after = placesIn(stretchKeys(group, refs, wanted));
        if (span.fromMs === span.toMs) {
          expect(after).toEqual(placesIn(group));
          return;
        }
        const factor = boundedFactor(group, refs, wanted);
        const moved = chosen.map((key) => ({ ...key, atMs: stretchedMs(key.atMs, { ...wanted, factor }) }));
        expect(after).toEqual([...moved, ...others].map(placeOf).sort());
      }),
    );
  });

  test('of all rows are stretched as the time of the range is', () => {
    fc.assert(
      fc.property(spaced, someStretch, fc.boolean(), (group, { tenths, fixed }, ripple) => {
        if (refsOf(group).length === 0) return;
        const span = spanOf(keysOf(group, refsOf(group)).chosen.map(({ atMs }) => atMs));
        const factor = tenths / 10;
        expect(stretchKeys(group, refsOf(group), { ...span, factor, fixed, ripple })).toEqual(
          fixed === 'last' ? stretchBack(group, span, factor) : stretch(group, span, factor, { ripple }),
        );
      }),
    );
  });

  test('with ripple everything behind goes along, in its order: no servo’s keys change places', () => {
    fc.assert(
      fc.property(scene, fc.integer({ min: 0, max: 30 }), ([group, refs], tenths) => {
        const { chosen, others } = keysOf(group, refs);
        if (chosen.length === 0) return;
        const span = spanOf(chosen.map(({ atMs }) => atMs));
        const wanted = { ...span, factor: tenths / 10, fixed: 'first', ripple: true } as const;
        const next = stretchKeys(group, refs, wanted);
        if (span.fromMs === span.toMs) return;
        const growthMs = Math.round((span.toMs - span.fromMs) * (boundedFactor(group, refs, wanted) - 1));
        const after = placesIn(next);
        for (const key of others) {
          const atMs = key.atMs > span.toMs ? key.atMs + growthMs : key.atMs;
          expect(after).toContain(placeOf({ ...key, atMs }));
        }
        const stay = Math.max(0, ...others.map(({ atMs }) => atMs).filter((atMs) => atMs <= span.toMs));
        const behind = others.filter(({ atMs }) => atMs > span.toMs).map(({ atMs }) => atMs + growthMs);
        expect(Math.min(...behind, Infinity)).toBeGreaterThanOrEqual(Math.min(stay, span.toMs + growthMs));
      }),
    );
  });

  test('none chosen, or all at one instant: nothing changes', () => {
    fc.assert(
      fc.property(spaced, fc.boolean(), (group, ripple) => {
        const endMs = frameEnds(group.frames).at(-1) ?? 0;
        const wanted = { fromMs: 0, toMs: endMs, factor: 2, fixed: 'first', ripple } as const;
        expect(stretchKeys(group, [], wanted)).toBe(group);
        expect(shapeOf(stretchKeys(group, refsOf(group), { ...wanted, fromMs: endMs }))).toEqual(
          shapeOf(group),
        );
      }),
    );
  });
});
