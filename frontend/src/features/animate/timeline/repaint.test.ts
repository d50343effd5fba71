import { expect, test } from 'vitest';
import { setColour } from '#shared/group/frameEdits.ts';
import { changedStretch } from './repaint.ts';
import { sceneOf } from './scene.ts';
import { sizesOf } from './rows.ts';
import { createTestTimeline } from './timelineUnderTest.ts';

/** A key and its frame reach so far beside their place. */
const BESIDE_PX = 12;
const SIZES = sizesOf(false, { isTall: false, large: null });

test('a key that is moved up or down has its place painted anew, everything else the whole', async () => {
  const { stores, context, select, key } = await createTestTimeline();
  const scene = () => sceneOf(context(), SIZES);
  select([2, 1]);
  const changedBy = (change: () => void) => {
    const before = scene();
    change();
    return changedStretch(before, scene());
  };
  const row = scene().rows.find(({ row: { servos } }) => servos[0] === 1);
  const [top, bottom] = [row?.top ?? 0, (row?.top ?? 0) + (row?.height ?? 0)];

  const nudged = changedBy(() => key('ArrowUp'));
  expect(nudged?.top).toBeLessThan(top);
  expect(nudged?.bottom).toBeGreaterThan(bottom);
  expect((nudged?.bottom ?? 0) - (nudged?.top ?? 0)).toBeLessThan(2 * (bottom - top));

  expect([nudged?.left, nudged?.right]).toEqual([50 - BESIDE_PX, 150 + BESIDE_PX]);

  expect(changedBy(() => key('ArrowRight'))).toBeNull();
  expect(changedBy(() => select([1, 1]))).toBeNull();
  expect(changedBy(() => stores.timeline.setState({ scrollTop: 10 }))).toBeNull();
  expect(changedBy(() => stores.timeline.setState({ range: { fromMs: 0, toMs: 500 } }))).toBeNull();
  expect(
    changedBy(() =>
      stores.document.edit(
        () => 'colour',
        (group) => setColour(group, [1], 'plum'),
      ),
    ),
  ).toBeNull();
});
