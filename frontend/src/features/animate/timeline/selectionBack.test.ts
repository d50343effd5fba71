import { expect, test } from 'vitest';
import { emptyGroup } from '#shared/group/group.ts';
import { startHistory } from '#shared/document/history.ts';
import { keepInStep } from './inStep.ts';
import { servoRowId } from './rows.ts';
import { createTestTimeline } from './timelineUnderTest.ts';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { createMemoryStore } from '../../library/memoryStore.ts';
import { createVisit } from '../../library/libraryUnderTest.ts';
import { keySet, createTimeline, restoreSelection, resetForOpenedGroup } from './timeline.ts';

/** As on the page: it hears of an edit before the listener that forgets what is gone. */
async function createStoredPage() {
  const page = await createTestTimeline();
  restoreSelection(page.stores);
  keepInStep(page.stores);
  const { document, timeline, view } = page.stores;
  return {
    ...page,
    document,
    seen: () => [page.selected(), timeline.getState().cursor.frameId, view.getState().selectedFrame],
  };
}

type TimelineContext = Awaited<ReturnType<typeof createStoredPage>>;

test.each<[string, (page: TimelineContext) => void]>([
  ['deleting', ({ key }) => key('Delete')],
  ['duplicating', ({ key }) => key('d', { ctrlKey: true })],
  ['turning round', ({ key }) => key('r')],
  ['dragging', ({ drag, spotOf }) => drag(spotOf(1, 1), 30, 0)],
])('undo selects what was selected before %s, redo what was afterwards', async (_, edit) => {
  const page = await createStoredPage();
  const { select, seen, document } = page;
  select([1, 1], [1, 2], [3, 3]);
  page.stores.timeline.setState({ cursor: { row: servoRowId(1), frameId: 1 } });
  const before = seen();
  edit(page);
  const after = seen();
  document.undo();
  expect(seen()).toEqual(before);
  document.redo();
  expect(seen()).toEqual(after);
  select([3, 1]);
  document.undo();
  expect(seen()).toEqual(before);
});

test('a drag that is undone amid it has done nothing, and what the hand still does counts no more', async () => {
  const { press, spotOf, seen, keys, document, steps } = await createStoredPage();
  const [from, before] = [steps(), keys(1)];
  const gesture = press(spotOf(1, 1));
  const pressed = seen();
  gesture.by(30, 0);
  document.undo();
  expect(seen()).toEqual(pressed);
  gesture.by(40, 0);
  gesture.end(false);
  expect(seen()).toEqual(pressed);
  expect(keys(1)).toEqual(before);
  expect(steps()).toBe(from);
});

test('keys that are deleted amid a drag are not selected when the hand lets go', async () => {
  const { press, spotOf, selected, key } = await createStoredPage();
  const gesture = press(spotOf(1, 1));
  gesture.by(30, 0);
  key('Delete');
  gesture.cancel();
  expect(selected()).toEqual([]);
});

test('a group that is opened again is looked at afresh', async () => {
  const { key, select, selected, document } = await createStoredPage();
  select([2, 1]);
  key('Delete');
  document.undo();
  select([1, 1]);
  const first = document.store.getState();
  document.take(startHistory(emptyGroup('Other', 'us')));
  select();
  document.take(first);
  expect(selected()).toEqual([]);
});

test('what was selected and looked at in one group is not in another, whose frames have the same ids', async () => {
  const timeline = createTimeline();
  const visit = createVisit(createMemoryStore(), createVirtualClock());
  resetForOpenedGroup({ ...visit, timeline });
  await visit.later();
  visit.capture(1000);
  const [frame] = visit.document.store.getState().present.frames;
  visit.view.setState({ selectedFrame: frame!.id });
  timeline.setState({
    ...{ selected: keySet([{ frameId: frame!.id, servo: 1 }]), playheadMs: 800, followsGroup: false },
    range: { fromMs: 0, toMs: 500 },
  });
  await visit.later();
  expect(timeline.getState()).toMatchObject({ playheadMs: 800, followsGroup: false });
  visit.library.create();
  visit.capture(1200);
  expect(visit.document.store.getState().present.frames[0]!.id).toBe(frame!.id);
  expect(visit.view.getState().selectedFrame).not.toBe(frame!.id);
  expect(timeline.getState()).toMatchObject({ playheadMs: 0, followsGroup: true, range: null });
  expect(timeline.getState().selected.size).toBe(0);
});
