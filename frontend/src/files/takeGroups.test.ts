import { expect, test } from 'vitest';
import { emptyGroup } from '#shared/actions/group/group.ts';
import { insertFrame } from '#shared/actions/group/groupEdits.ts';
import { createVirtualClock } from '#shared/simulator/virtualClock.ts';
import { createMemoryKeeper } from '../keepers/memoryKeeper.ts';
import { createVisit } from '../stores/library/libraryUnderTest.ts';
import { takeGroups } from './takeGroups.ts';

const group = (name: string) =>
  insertFrame(emptyGroup(name, 'us'), 0, { durationMs: 100, targets: [{ servo: 1, position: 1500 }] });

test('groups of files become documents; what was being written is still there', async () => {
  const page = createVisit(createMemoryKeeper(), createVirtualClock());
  takeGroups(page, [group('Wave'), group('Bow')]);
  expect(page.told()).toEqual(['One more group is in the library.']);
  await page.later();
  expect(page.group().name).toBe('Wave');
  takeGroups(page, [group('Nod')]);
  await page.library.refresh();
  expect(page.names()).toEqual(['Bow', 'Nod', 'Wave']);
  page.document.undo();
  expect(page.group().frames).toHaveLength(0);
});

test('what is taken is shown, whatever was worked on', () => {
  const page = createVisit(createMemoryKeeper(), createVirtualClock());
  page.view.setState({ authoring: 'poses' });
  takeGroups(page, [group('Wave')]);
  expect(page.view.getState().authoring).toBe('group');
});
