import { expect, test } from 'vitest';
import { FAMILIES } from '#shared/codec/families.ts';
import { emptyGroup } from '#shared/group/group.ts';
import { setMeta } from '#shared/group/groupEdits.ts';
import { startHistory } from '#shared/document/history.ts';
import { createTestPage } from '../../pageUnderTest.ts';
import { chosenTimes } from './groupPlace.ts';
import { createSharedSlots, storedGroup } from './sharedSlotsUnderTest.ts';

const FRAMES = [{ durationMs: 400, targets: [{ servo: 1, position: 1000 }] }];

async function openTestPage(...options: Parameters<typeof createTestPage>) {
  const page = await createTestPage(...options);
  const { document, opened, view, place } = page;
  return {
    ...page,
    keep: (change: Parameters<typeof setMeta>[1]) =>
      document.edit(
        () => 'keep',
        (group) => setMeta(group, change),
      ),
    open(openId: string, change: Parameters<typeof setMeta>[1] = {}): void {
      document.take(startHistory(setMeta(emptyGroup(openId, 'us'), change)));
      opened.setState({ openId });
    },
    slot: () => place.store.getState().slot,
    times: () => chosenTimes(view.getState()),
  };
}

test('a group’s own slot and times are what is chosen, also when they are undone', async () => {
  const { keep, slot, times, document } = await openTestPage();
  keep({ slot: 5, times: 2 });
  expect([slot(), times()]).toEqual([5, 2]);
  keep({ times: 0 });
  expect([slot(), times()]).toEqual([5, 0]);
  document.undo();
  expect([slot(), times()]).toEqual([5, 2]);
});

test('what is chosen otherwise holds until another group is opened, which never gets the slot of the one before', async () => {
  const { open, slot, times, view, capture } = await openTestPage().then((page) => ({
    ...page,
    capture: () => page.keep({ name: 'Waving' }),
  }));
  open('wave', { slot: 2 });
  expect(slot()).toBe(2);
  view.setState({ slot: 9, times: 4 });
  capture();
  expect([slot(), times()]).toEqual([9, 4]);
  open('bow');
  expect([slot(), times()]).toEqual([21, 1]);
  open('wave', { slot: 2 });
  expect(slot()).toBe(2);
});

test('a group without a slot gets the one that has it, else a free one that no pad plays', async () => {
  const { open, slot, slots, draw } = await openTestPage();
  slots.download([{ slot: 30, name: 'wave', documentId: 'wave', frames: FRAMES }]);
  await draw(2000);
  open('wave');
  expect(slot()).toBe(30);
  open('bow');
  expect(slot()).toBe(21);
  slots.download([{ slot: 21, name: 'nod', documentId: 'nod', frames: FRAMES }]);
  await draw(2000);
  expect(slot()).toBe(22);
});

test('an erase takes the group off the board, not its slot from the group', async () => {
  const { open, slot, slots, draw } = await openTestPage();
  slots.download([{ slot: 30, name: 'wave', documentId: 'wave', frames: FRAMES }]);
  await draw(2000);
  open('wave');
  slots.erase();
  await draw(5000);
  expect(slots.store.getState().book.isEmptied).toBe(true);
  expect(slot()).toBe(30);
});

test('what others have stored is not free', async () => {
  const { share, othersStore } = createSharedSlots({ 21: storedGroup({ version: 'of Bert' }) });
  const { slot } = await openTestPage(new Map(), { share });
  expect(slot()).toBe(22);
  othersStore(22, { version: 'of Bert' });
  expect(slot()).toBe(23);
});

test('of a board that takes no groups the first slot is run until another one is chosen', async () => {
  const { open, slot, view } = await openTestPage(new Map(), { family: FAMILIES['lsc-16'] });
  expect(slot()).toBe(0);
  view.setState({ slot: 8 });
  expect(slot()).toBe(8);
  open('bow');
  expect(slot()).toBe(0);
});
