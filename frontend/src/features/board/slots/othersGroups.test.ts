import { compileSource } from '../compile/compileSource.ts';
import { expect, test } from 'vitest';
import { createStore } from 'zustand/vanilla';
import { emptyGroup, type ActionGroup, groupToText } from '#shared/group/group.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { factsOf } from '#shared/files/facts.ts';
import type { Listed } from '#shared/files/documentStore.ts';
import { createMemoryStore } from '../../library/memoryStore.ts';
import { createTestPage } from '../../pageUnderTest.ts';
import type { Way } from '../../../robot/device.ts';
import type { LibraryState } from '../../library/library.ts';
import { findOthersGroups } from './othersGroups.ts';
import { createSharedSlots } from './sharedSlotsUnderTest.ts';

const WAY: Way = { kind: 'gateway', label: '/dev/board', isSimulated: false };

const groupAt = (...positions: readonly number[]): ActionGroup =>
  positions.reduce(
    (sum, position) => insertFrame(sum, 9, { durationMs: 400, targets: [{ servo: 1, position }] }),
    emptyGroup('Wave', 'us'),
  );

async function openTestPage() {
  const gateway = createSharedSlots();
  const page = await createTestPage(new Map(), { way: WAY, share: gateway.share });
  const { device, robots, compiled, slots } = page;
  const documentStore = createMemoryStore();
  const store = createStore<LibraryState>(() => ({
    ...{ place: 'gateway', documents: [], listings: 0, openId: 'at hand', isSaved: true },
  }));
  const refreshed: string[] = [];
  const library = { store, refresh: () => Promise.resolve(void refreshed.push('the list')) };
  const read: string[] = [];
  const watched = { ...documentStore, read: (id: string) => (read.push(id), documentStore.read(id)) };
  findOthersGroups({ device, robots, compiled, slots, library, documentStore: Promise.resolve(watched) });
  const on = { family: device.store.getState().family, robot: robots.current().robot };
  let revision = 0;
  return {
    ...{ ...page, ...gateway, documentStore, read, refreshed },
    versionOf: (group: ActionGroup) => compiled.of(group, on, compileSource).fingerprint,
    async shelve(group: ActionGroup): Promise<void> {
      const facts = factsOf(group, { updatedAtMs: 0, robot: '' });
      const writing = { text: groupToText(group), facts, expected: revision, isRemoved: false };
      revision = await documentStore.write('wave', writing);
      const listed: Listed = { id: 'wave', revision, isRemoved: false, facts };
      store.setState({ documents: [listed] });
    },
    known: () => slots.store.getState().book.stored.map(({ slot, by, frames }) => [slot, by, frames.length]),
  };
}

test('what others stored is known whole where the library holds that version of the document', async () => {
  const { shelve, othersStore, versionOf, known, draw } = await openTestPage();
  await shelve(groupAt(1000, 1400));
  othersStore(5, { version: versionOf(groupAt(1000, 1400)), documentId: 'wave', name: 'Wave', by: 'Bert' });
  othersStore(6, { version: versionOf(groupAt(1000, 1500)), documentId: 'wave', name: 'Wave', by: 'Bert' });
  othersStore(7, { version: versionOf(groupAt(1000, 1400)), documentId: 'gone' });
  othersStore(8, { version: versionOf(groupAt(1000, 1400)) });
  await draw(100);
  expect(known()).toEqual([[5, 'Bert', 2]]);
});

test('what the library does not list is asked of the list, once, and not read', async () => {
  const { othersStore, read, refreshed, draw } = await openTestPage();
  othersStore(5, { version: 'of Bert', documentId: 'new' });
  othersStore(6, { version: 'of Bert', documentId: 'new' });
  await draw(100);
  expect([refreshed, read]).toEqual([['the list'], []]);
});

test('a version that was kept under a name counts, and one that the library gets later', async () => {
  const { shelve, documentStore, othersStore, versionOf, known, draw } = await openTestPage();
  await shelve(groupAt(1000));
  const version = { id: 'kept', name: 'First', atMs: 1 };
  await documentStore.keepVersion('wave', version, groupToText(groupAt(1000, 1200)));
  othersStore(5, { version: versionOf(groupAt(1000, 1200)), documentId: 'wave', by: 'Bert' });
  othersStore(6, { version: versionOf(groupAt(1000, 1200, 1300)), documentId: 'wave', by: 'Bert' });
  await draw(100);
  expect(known()).toEqual([[5, 'Bert', 2]]);
  await shelve(groupAt(1000, 1200, 1300));
  await draw(100);
  expect(known()).toEqual([
    [5, 'Bert', 2],
    [6, 'Bert', 3],
  ]);
});

test('an erase takes one’s own and theirs, and all of it comes back', async () => {
  const { slots, shelve, othersStore, othersErase, versions, versionOf, known, draw } = await openTestPage();
  await shelve(groupAt(1000, 1400));
  othersStore(5, { version: versionOf(groupAt(1000, 1400)), documentId: 'wave', by: 'Bert' });
  const own = { slot: 9, name: 'Bow', documentId: null, frames: groupAt(1200).frames };
  slots.download([own]);
  await draw(100);
  const before = versions();
  othersErase();
  await draw(100);
  expect(known()).toEqual([]);
  slots.restoreAll();
  await draw(100);
  expect(Object.keys(versions())).toEqual(Object.keys(before));
  expect(known()).toEqual([
    [5, undefined, 2],
    [9, undefined, 1],
  ]);
  expect(slots.store.getState().book.erased).toEqual([]);
});
