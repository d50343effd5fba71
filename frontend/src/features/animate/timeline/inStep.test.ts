import { expect, test } from 'vitest';
import { deleteFrames, duplicateFrames, insertFrame } from '#shared/group/groupEdits.ts';
import { keepInStep } from './inStep.ts';
import { createTestTimeline } from './timelineUnderTest.ts';

test('a frame that is selected elsewhere is selected here, and looked at', async () => {
  const { stores, selected } = await createTestTimeline();
  const end = keepInStep(stores);
  stores.view.setState({ selectedFrame: 2 });
  expect(selected()).toEqual([
    [2, 1],
    [2, 2],
  ]);
  expect(stores.timeline.getState().playheadMs).toBe(1000);
  end();
  stores.view.setState({ selectedFrame: 3 });
  expect(selected()).toEqual([
    [2, 1],
    [2, 2],
  ]);
});

test('a frame may be announced before it is there', async () => {
  const { stores, selected } = await createTestTimeline();
  keepInStep(stores);
  stores.view.setState({ selectedFrame: 4 });
  stores.document.edit(
    () => 'duplicate',
    (group) => duplicateFrames(group, [1]),
  );
  expect(selected()).toEqual([
    [4, 1],
    [4, 2],
    [4, 3],
  ]);
  expect(stores.view.getState().selectedFrame).toBe(4);
});

test('a frame without keys is looked at, too', async () => {
  const { stores, selected } = await createTestTimeline();
  stores.document.edit(
    () => 'rest',
    (group) => insertFrame(group, 1, { durationMs: 300, targets: [] }),
  );
  keepInStep(stores);
  stores.view.setState({ selectedFrame: 1 });
  stores.view.setState({ selectedFrame: 4 });
  expect(stores.timeline.getState()).toMatchObject({ playheadMs: 800, cursor: { frameId: 4 } });
  expect(selected()).toEqual([]);
  expect(stores.view.getState().selectedFrame).toBe(4);
  stores.view.setState({ selectedFrame: 1 });
  expect(selected()).toHaveLength(3);
});

test('what is gone is no longer selected', async () => {
  const { stores, select, selected } = await createTestTimeline();
  keepInStep(stores);
  select([1, 1], [2, 1]);
  stores.document.edit(
    () => 'delete',
    (group) => deleteFrames(group, [1]),
  );
  expect(selected()).toEqual([[2, 1]]);
});

test('of a frame that loses a key the others are not selected instead, and the playhead stays', async () => {
  const { stores, key, click, drag, spotOf, selected, keys } = await createTestTimeline();
  keepInStep(stores);
  stores.timeline.setState({ playheadMs: 200 });
  const left = (): unknown => [selected(), stores.timeline.getState().playheadMs];
  click(spotOf(1, 2));
  key('Delete');
  expect(left()).toEqual([[], 200]);
  key('Delete');
  expect(keys(2)).toHaveLength(3);
  click(spotOf(1, 3));
  key('ArrowRight');
  expect(left()).toEqual([[[4, 1]], 200]);
  drag(spotOf(2, 3), 30, 0);
  expect(left()).toEqual([[[5, 2]], 200]);
});

test('where the cursor’s key is gone it is at the nearest one of its row', async () => {
  const { stores, key } = await createTestTimeline();
  keepInStep(stores);
  key('ArrowDown');
  for (let presses = 0; presses < 3; presses += 1) key('ArrowRight', { ctrlKey: true });
  key('Delete');
  expect(stores.timeline.getState().cursor).toEqual({ row: 'servo 1', frameId: 2 });
  key('a', { ctrlKey: true });
  key('Delete');
  expect(stores.timeline.getState().cursor).toEqual({ row: 'servo 1', frameId: null });
});

test('all of the group stays in sight until one looks closer', async () => {
  const { stores } = await createTestTimeline();
  keepInStep(stores);
  const { time } = stores.timeline.getState();
  stores.document.edit(
    () => 'duplicate',
    (group) => duplicateFrames(group, [1]),
  );
  expect(stores.timeline.getState().time.msPerPx).toBeGreaterThan(time.msPerPx);
});

test('a playhead that moves out of sight is followed a page at a time, unless one has looked away', async () => {
  const { stores } = await createTestTimeline();
  keepInStep(stores);
  const { timeline } = stores;
  const xOfPlayhead = (): number => {
    const { time, playheadMs } = timeline.getState();
    return (playheadMs - time.fromMs) / time.msPerPx;
  };
  timeline.setState({ time: { fromMs: 0, msPerPx: 1 }, playheadMs: 790, followsGroup: false });
  timeline.setState({ playheadMs: 799 });
  expect(xOfPlayhead()).toBe(799);
  timeline.setState({ playheadMs: 816 });
  expect(xOfPlayhead()).toBe(24);
  timeline.setState({ playheadMs: 0 });
  expect(xOfPlayhead()).toBe(24);

  timeline.setState({ time: { fromMs: 1000, msPerPx: 1 } });
  timeline.setState({ playheadMs: 16 });
  expect(timeline.getState().time.fromMs).toBe(1000);
});
