import { expect, test } from 'vitest';
import { startHistory } from '#shared/document/history.ts';
import { rangeOf } from './context.ts';
import { scaleAt } from './valueText.ts';
import { keyY } from './rows.ts';
import { sceneOf } from './scene.ts';
import { sizesOf } from './rows.ts';
import { createTestTimeline, smallGroup } from './timelineUnderTest.ts';

async function pageInSteps() {
  const context = await createTestTimeline();
  const small = smallGroup();
  const [low, middle, high] = [0, 500, 1000];
  const frames = small.frames.map((frame, index) => ({
    ...frame,
    targets: [{ servo: 1, position: [low, middle, high][index] ?? 0 }],
  }));
  context.stores.document.take(startHistory({ ...small, unit: 'steps', frames }));
  return context;
}

test('a group for a board that counts in steps is drawn as it is beside one in microseconds', async () => {
  const { context } = await pageInSteps();
  const scene = sceneOf(context(), sizesOf(false, { isTall: false, large: null }));
  const row = scene.rows.find(({ row: { servos, kind } }) => kind === 'servo' && servos[0] === 1)!;
  const [bottom, middle, top] = [0, 500, 1000].map((position) => keyY(row, position, scene.family));
  expect(bottom).toBeGreaterThan(middle!);
  expect(middle).toBe((bottom! + top!) / 2);
  expect(rangeOf(context(), 1)).toMatchObject({ min: 0, max: 1000 });
  expect(scaleAt(context(), 1).text(500)).toBe('500 steps');
});

test('its keys go as far as steps do', async () => {
  const { select, key, keys } = await pageInSteps();
  select([2, 1], [3, 1]);
  key('ArrowDown');
  expect(keys(1).map(([, position]) => position)).toEqual([0, 499, 999]);
});
