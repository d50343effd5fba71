import { expect, test } from 'vitest';
import { makeBlock } from '#shared/group/blockEdits.ts';
import { emptyGroup } from '#shared/group/group.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { createMemoryStore } from '../memoryStore.ts';
import { createVisit } from '../libraryUnderTest.ts';
import { takeGroup, takeGroups } from './openedFiles.ts';

const group = (name: string) =>
  insertFrame(emptyGroup(name, 'us'), 0, { durationMs: 100, targets: [{ servo: 1, position: 1500 }] });

function course() {
  const taken: number[] = [];
  const ends = new AbortController();
  return { ends, taken, signal: ends.signal, onTaken: (index: number) => void taken.push(index) };
}

test('groups of files become documents; what was being written is still there', async () => {
  const page = createVisit(createMemoryStore(), createVirtualClock());
  await takeGroups(page, [group('Wave'), group('Bow')], course());
  expect(page.noticeTexts()).toEqual(['One more group is in the library.']);
  await page.later();
  expect(page.group().name).toBe('Wave');
  takeGroup(page, group('Nod'));
  await page.library.refresh();
  expect(page.names()).toEqual(['Bow', 'Nod', 'Wave']);
  page.document.undo();
  expect(page.group().frames).toHaveLength(0);
});

test('a group made only of blocks is not written over', async () => {
  const page = createVisit(createMemoryStore(), createVirtualClock());
  const blocks = makeBlock(group('Turn'), [{ frameId: 1, servo: 1 }], 'All')!;
  expect(blocks.frames).toEqual([]);
  takeGroup(page, blocks);
  await page.later();
  takeGroup(page, group('Wave'));
  await page.later();
  await page.library.refresh();
  expect(page.names()).toEqual(['Turn', 'Wave']);
});

test('what is taken is shown, whatever was worked on', () => {
  const page = createVisit(createMemoryStore(), createVirtualClock());
  page.view.setState({ authoring: 'poses' });
  takeGroup(page, group('Wave'));
  expect(page.view.getState().authoring).toBe('group');
});

const MANY = Array.from({ length: 103 }, (_, index) => group(`Wave ${index + 1}`));

test('of many each is in the library before the next is begun', async () => {
  const documentStore = createMemoryStore();
  const page = createVisit(documentStore, createVirtualClock());
  const inLibrary: number[] = [];
  const { signal } = new AbortController();
  const onTaken = (index: number) =>
    void documentStore.list().then(({ documents }) => inLibrary.push(documents.length - index));
  await takeGroups(page, MANY, { signal, onTaken });
  expect(Math.max(...inLibrary.slice(1))).toBeLessThanOrEqual(2);
  await page.later();
  expect(page.noticeTexts()).toEqual(['102 more groups are in the library.']);
  await page.library.refresh();
  expect(page.names()).toHaveLength(103);
});

test('after a cancel those that were taken are in the library, and the others are not', async () => {
  const page = createVisit(createMemoryStore(), createVirtualClock());
  const cancelled = course();
  await takeGroups(page, MANY, {
    signal: cancelled.signal,
    onTaken(index) {
      cancelled.onTaken(index);
      if (index === 4) cancelled.ends.abort();
    },
  });
  expect(cancelled.taken).toEqual([0, 1, 2, 3, 4]);
  await page.later();
  await page.library.refresh();
  expect(page.names()).toEqual(['Wave 1', 'Wave 2', 'Wave 3', 'Wave 4', 'Wave 5']);
});

test('where the library never answers all of them wait here, and are there in the next visit', async () => {
  const clock = createVirtualClock();
  const texts = new Map<string, string>();
  const page = createVisit(new Promise<never>(() => undefined), clock, texts);
  const taking = takeGroups(page, MANY, course());
  await clock.advance(1000);
  await taking;
  page.leave();
  const next = createVisit(createMemoryStore(), clock, texts);
  await next.later();
  await next.library.refresh();
  expect(next.names()).toHaveLength(103);
});
