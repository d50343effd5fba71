import { expect, test } from 'vitest';
import { deleteFrame, duplicateFrame } from '#shared/actions/group/groupEdits.ts';
import { keepInStep } from './inStep.ts';
import { createTimelineDesk } from './timelineUnderTest.ts';

test('a frame that is selected elsewhere is selected here, and looked at', async () => {
  const { stores, selected } = await createTimelineDesk();
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
  const { stores, selected } = await createTimelineDesk();
  keepInStep(stores);
  stores.view.setState({ selectedFrame: 4 });
  stores.document.edit(
    () => 'duplicate',
    (group) => duplicateFrame(group, 1),
  );
  expect(selected()).toEqual([
    [4, 1],
    [4, 2],
    [4, 3],
  ]);
  expect(stores.view.getState().selectedFrame).toBe(4);
});

test('what is gone is no longer selected', async () => {
  const { stores, select, selected } = await createTimelineDesk();
  keepInStep(stores);
  select([1, 1], [2, 1]);
  stores.document.edit(
    () => 'delete',
    (group) => deleteFrame(group, 1),
  );
  expect(selected()).toEqual([[2, 1]]);
});

test('all of the group stays in sight until one looks closer', async () => {
  const { stores } = await createTimelineDesk();
  keepInStep(stores);
  const { time } = stores.timeline.getState();
  stores.document.edit(
    () => 'duplicate',
    (group) => duplicateFrame(group, 1),
  );
  expect(stores.timeline.getState().time.msPerPx).toBeGreaterThan(time.msPerPx);
});
