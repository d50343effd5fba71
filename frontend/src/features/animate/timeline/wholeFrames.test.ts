import { expect, test } from 'vitest';
import { keySet } from './timeline.ts';
import { pressFrame } from './inStep.ts';
import { createTestTimeline } from './timelineUnderTest.ts';
import { wholeFrames } from './wholeFrames.ts';

const ALL = new Set([1, 2, 3]);

test('a frame is selected as a whole where all of its keys are that are shown', async () => {
  const { context } = await createTestTimeline();
  const whole = (keys: readonly (readonly [frameId: number, servo: number])[], shown = ALL) =>
    wholeFrames(context().times, keySet(keys.map(([frameId, servo]) => ({ frameId, servo }))), shown);
  expect(whole([])).toEqual([]);
  expect(whole([[2, 1]])).toEqual([]);
  expect(
    whole([
      [3, 1],
      [2, 2],
      [2, 1],
    ]),
  ).toEqual([2]);
  expect(
    whole(
      [
        [3, 1],
        [3, 2],
        [1, 1],
        [1, 2],
      ],
      new Set([1, 2]),
    ),
  ).toEqual([1, 3]);
});

test('a frame without a key to select goes with the whole frames on both sides of it', async () => {
  const { context } = await createTestTimeline();
  const whole = (servo: number, ...frames: readonly number[]) =>
    wholeFrames(context().times, keySet(frames.map((frameId) => ({ frameId, servo }))), new Set([servo]));
  expect(whole(3, 1, 3)).toEqual([1, 2, 3]);
  expect([whole(3, 1), whole(3, 3)]).toEqual([[1], [3]]);
  expect(whole(1, 1, 3)).toEqual([1, 3]);
});

test('cards take others along: with Shift up to it, with Ctrl beside others', async () => {
  const { stores, context } = await createTestTimeline();
  const chosen = () => wholeFrames(context().times, stores.timeline.getState().selected, ALL);
  const press = (id: number, held = {}) => pressFrame(stores, id, { ctrl: false, shift: false, ...held });
  press(1);
  expect(chosen()).toEqual([1]);
  press(3, { shift: true });
  expect(chosen()).toEqual([1, 2, 3]);
  expect(stores.view.getState().selectedFrame).toBe(1);
  press(2, { ctrl: true });
  expect(chosen()).toEqual([1, 3]);
  press(2, { ctrl: true });
  expect(chosen()).toEqual([1, 2, 3]);
  press(2);
  expect(chosen()).toEqual([2]);
  expect(stores.timeline.getState().playheadMs).toBe(1000);
});
