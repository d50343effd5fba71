import { expect, test } from 'vitest';
import { emptyGroup } from '#shared/group/group.ts';
import { startHistory } from '#shared/document/history.ts';
import { keepInStep } from './inStep.ts';
import { servoRowId } from './rows.ts';
import { bringSelectionBack } from './selectionBack.ts';
import { createTimelineDesk } from './timelineUnderTest.ts';

/** As on the page: it hears of an edit before whoever forgets what is gone. */
async function createKeptDesk() {
  const desk = await createTimelineDesk();
  bringSelectionBack(desk.stores);
  keepInStep(desk.stores);
  const { document, timeline, view } = desk.stores;
  return {
    ...desk,
    document,
    seen: () => [desk.selected(), timeline.getState().cursor.frameId, view.getState().selectedFrame],
  };
}

type Desk = Awaited<ReturnType<typeof createKeptDesk>>;

test.each<[string, (desk: Desk) => void]>([
  ['deleting', ({ key }) => key('Delete')],
  ['duplicating', ({ key }) => key('d', { ctrlKey: true })],
  ['turning round', ({ key }) => key('r')],
  ['dragging', ({ drag, spotOf }) => drag(spotOf(1, 1), 30, 0)],
])('undo selects what was selected before %s, redo what was afterwards', async (_, edit) => {
  const desk = await createKeptDesk();
  const { select, seen, document } = desk;
  select([1, 1], [1, 2], [3, 3]);
  desk.stores.timeline.setState({ cursor: { row: servoRowId(1), frameId: 1 } });
  const before = seen();
  edit(desk);
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
  const { press, spotOf, seen, keys, document, steps } = await createKeptDesk();
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
  const { press, spotOf, selected, key } = await createKeptDesk();
  const gesture = press(spotOf(1, 1));
  gesture.by(30, 0);
  key('Delete');
  gesture.cancel();
  expect(selected()).toEqual([]);
});

test('a group that is opened again is looked at afresh', async () => {
  const { key, select, selected, document } = await createKeptDesk();
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
