import { describe, expect, test } from 'vitest';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { keepInStep, pressFrame } from '../timeline/inStep.ts';
import { createTestTimeline } from '../timeline/timelineUnderTest.ts';
import { words } from '../../../i18n/whole.ts';
import {
  chosenFrames,
  copy,
  cut,
  duplicate,
  moveBy,
  paste,
  removeFrames,
  selectAllFrames,
  wholeFrames,
} from './frameVerbs.ts';
import { keySet, restoreSelection } from '../timeline/timeline.ts';

/** Frames 1 to 5 of 500 ms, the first three with keys of several servos. */
async function createStrip() {
  const context = await createTestTimeline();
  const { stores, group } = context;
  for (const position of [1100, 1300])
    stores.document.edit(
      () => 'more',
      (before) => insertFrame(before, 9, { durationMs: 500, targets: [{ servo: 1, position }] }),
    );
  restoreSelection(stores);
  keepInStep(stores);
  return {
    ...{ ...context, stores },
    ids: () => group().frames.map(({ id }) => id),
    chosen: () => chosenFrames(stores),
    label: () => stores.document.store.getState().past.at(-1)?.label(),
    choose(...ids: readonly number[]) {
      for (const [index, id] of ids.entries()) pressFrame(stores, id, { ctrl: index > 0, shift: false });
    },
    said: () => stores.notices.said.getState(),
  };
}

describe('several frames', () => {
  test('move together as one step, stay selected, and come back by undo', async () => {
    const { stores, ids, chosen, choose, label, said } = await createStrip();
    choose(2, 3);
    moveBy(stores, 3, 1);
    expect(ids()).toEqual([1, 4, 2, 3, 5]);
    expect([chosen(), label(), said()]).toEqual([[2, 3], 'move 2 frames', '2 frames are now frames 3 to 4']);
    moveBy(stores, 2, -9);
    expect(ids()).toEqual([2, 3, 1, 4, 5]);
    stores.document.undo();
    stores.document.undo();
    expect([ids(), chosen()]).toEqual([
      [1, 2, 3, 4, 5],
      [2, 3],
    ]);
  });

  test('meet where they were apart: on the way back at the first of them, on the way on at the last', async () => {
    const { stores, ids, choose } = await createStrip();
    choose(2, 4);
    moveBy(stores, 4, -1);
    expect(ids()).toEqual([2, 4, 1, 3, 5]);
    stores.document.undo();
    moveBy(stores, 2, 1);
    expect(ids()).toEqual([1, 3, 5, 2, 4]);
  });

  test('that cannot go farther make no step', async () => {
    const { stores, choose, steps, said } = await createStrip();
    choose(1, 2);
    const before = steps();
    moveBy(stores, 1, -1);
    expect([steps(), said()]).toEqual([before, '']);
  });

  test('a frame beside those that are selected moves alone', async () => {
    const { stores, ids, chosen, choose, label, said } = await createStrip();
    choose(1, 2);
    moveBy(stores, 4, -1);
    expect([ids(), chosen(), label(), said()]).toEqual([
      [1, 2, 4, 3, 5],
      [4],
      'move frame 4',
      'Frame 4 is now frame 3',
    ]);
  });

  test('are duplicated behind the last of them, and the copies selected', async () => {
    const { stores, ids, chosen, choose, label } = await createStrip();
    choose(1, 3);
    duplicate(stores, chosen());
    expect([ids(), chosen(), label()]).toEqual([[1, 2, 3, 6, 7, 4, 5], [6, 7], 'duplicate 2 frames']);
    expect(stores.timeline.getState().playheadMs).toBe(2000);
    stores.document.undo();
    expect(chosen()).toEqual([1, 3]);
  });

  test('go at once, and what comes next is selected', async () => {
    const { stores, ids, chosen, choose, label } = await createStrip();
    choose(2, 4);
    removeFrames(stores, chosen());
    expect([ids(), chosen(), label()]).toEqual([[1, 3, 5], [3], 'delete 2 frames']);
    stores.document.undo();
    expect(chosen()).toEqual([2, 4]);
    selectAllFrames(stores, 5);
    removeFrames(stores, chosen());
    expect([ids(), chosen()]).toEqual([[], []]);
  });

  test('take the rest between them along', async () => {
    const { stores, ids, chosen, choose } = await createStrip();
    stores.document.edit(
      () => 'rest',
      (before) => insertFrame(before, 2, { durationMs: 300, targets: [] }),
    );
    expect(ids()).toEqual([1, 2, 6, 3, 4, 5]);
    choose(2, 3);
    expect(chosen()).toEqual([2, 6, 3]);
    moveBy(stores, 2, 1);
    expect(ids()).toEqual([1, 4, 2, 6, 3, 5]);
    choose(4, 3);
    expect(chosen()).toEqual([4, 3]);
  });
});

describe('frames on the clipboard', () => {
  test('are cut as one step and pasted behind the selected ones, with all they hold', async () => {
    const { stores, ids, chosen, choose, label, group } = await createStrip();
    const [, second, third] = group().frames;
    choose(2, 3);
    cut(stores, chosen());
    expect([ids(), chosen(), label()]).toEqual([[1, 4, 5], [4], 'cut 2 frames']);
    choose(5, 1);
    paste(stores, stores.timeline.getState().clip);
    expect([ids(), chosen(), label()]).toEqual([[1, 4, 5, 6, 7], [6, 7], 'paste 2 frames']);
    expect(group().frames.slice(3)).toEqual([
      { ...second, id: 6 },
      { ...third, id: 7 },
    ]);
    stores.document.undo();
    expect([ids(), chosen()]).toEqual([
      [1, 4, 5],
      [1, 5],
    ]);
  });

  test('come to the end where no frame is selected', async () => {
    const { stores, ids, choose, chosen } = await createStrip();
    choose(2);
    copy(stores, chosen());
    stores.view.setState({ selectedFrame: null });
    paste(stores, stores.timeline.getState().clip);
    expect(ids()).toEqual([1, 2, 3, 4, 5, 6]);
  });

  test('are not pasted where the robot must not go, nor when there are none', async () => {
    const { stores, ids, noticeTexts } = await createStrip();
    paste(stores, null);
    const moments = [{ atMs: 0, easing: 'linear', note: '', colour: null, targets: [] }] as const;
    const far = [{ servo: 1, position: 9000 }];
    paste(stores, { unit: 'us', leadMs: 500, moments: [{ ...moments[0], targets: far }] });
    expect(ids()).toEqual([1, 2, 3, 4, 5]);
    expect(noticeTexts()).toEqual([
      words.actions.nothingToPaste,
      expect.stringContaining('Not pasted: Gripper at 9000 is out of range'),
    ]);
  });
});

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
