import { describe, expect, test } from 'vitest';
import type { Reading } from '#shared/files/reading.ts';
import { emptyGroup } from '#shared/group/group.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { readyGroups } from './answers.ts';
import { createOpenedFiles } from './openedFiles.ts';

const file = (name: string) => new File([], name);
const MANY = Array.from({ length: 103 }, (_, index) => file(`${index + 1}.csv`));

const groupIn = ({ name }: File): Reading => ({
  groups: [
    insertFrame(emptyGroup(name, 'us'), 0, { durationMs: 100, targets: [{ servo: 1, position: 1500 }] }),
  ],
  isUnitMissing: false,
  remarks: [],
});

/** Reads when it is let. */
function createPlace() {
  const requested: (() => void)[] = [];
  let stopped = 0;
  const files = createOpenedFiles({
    read: (one) => new Promise((resolve) => requested.push(() => resolve(groupIn(one)))),
    stop: () => (stopped += 1),
  });
  return {
    files,
    /** So many files, one after the other. */
    async letRead(count: number) {
      for (let read = 0; read < count; read += 1) {
        requested.shift()?.();
        await new Promise((resolve) => setImmediate(resolve));
      }
    },
    requested,
    stopped: () => stopped,
    names: () => files.store.getState().list.map(({ name }) => name),
    state: () => files.store.getState(),
  };
}

const namesOf = (files: readonly File[]) => files.map(({ name }) => name);

describe('reading', () => {
  test('is one file at a time, says how far it has come, and each is in the list as soon as it is read', async () => {
    const { files, letRead, requested, names, state } = createPlace();
    files.open(MANY);
    expect(state().reading).toEqual({ done: 0, total: 103 });
    await letRead(3);
    expect(requested).toHaveLength(1);
    expect(state().reading).toEqual({ done: 3, total: 103 });
    expect(names()).toEqual(['1.csv', '2.csv', '3.csv']);
    await letRead(100);
    expect(state().reading).toBeNull();
    expect(names()).toEqual(namesOf(MANY));
  });

  test('goes on with files that are opened meanwhile; those of a batch stand together, the newest first', async () => {
    const { files, letRead, names, state } = createPlace();
    files.open([file('a'), file('b')]);
    await letRead(1);
    files.open([file('c'), file('d')]);
    expect(state().reading).toEqual({ done: 1, total: 4 });
    await letRead(3);
    expect(names()).toEqual(['c', 'd', 'a', 'b']);
  });

  test('ends when it is cancelled: what was read stays, the rest is counted, and the next files are read', async () => {
    const { files, letRead, stopped, names, state } = createPlace();
    files.open(MANY);
    await letRead(37);
    files.cancelReading();
    expect(state()).toMatchObject({ reading: null, unread: 66 });
    expect(stopped()).toBe(1);
    // What was under way may still end.
    await letRead(1);
    expect(names()).toEqual(namesOf(MANY.slice(0, 37)));
    files.open([file('later')]);
    expect(state()).toMatchObject({ reading: { done: 0, total: 1 }, unread: 0 });
    await letRead(1);
    expect(names()).toEqual(['later', ...namesOf(MANY.slice(0, 37))]);
  });
});

describe('taking', () => {
  test('takes each file off the list as its group is taken; after a cancel the others are still there', async () => {
    const { files, letRead, names, state } = createPlace();
    files.open(MANY);
    await letRead(103);
    const isDone = await files.take(readyGroups(state().list, 'us'), async (groups, { signal, onTaken }) => {
      for (const index of groups.keys()) {
        await Promise.resolve();
        onTaken(index);
        expect(state().taking).toEqual({ done: index + 1, total: 103 });
        if (index === 9) files.cancelTaking();
        if (signal.aborted) return;
      }
    });
    expect(isDone).toBe(false);
    expect(state().taking).toBeNull();
    expect(names()).toEqual(namesOf(MANY.slice(10)));
    expect(
      await files.take(readyGroups(state().list, 'us'), (groups, { onTaken }) => {
        for (const index of groups.keys()) onTaken(index);
        return Promise.resolve();
      }),
    ).toBe(true);
    expect(names()).toEqual([]);
  });
});
