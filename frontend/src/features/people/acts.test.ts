import { expect, test } from 'vitest';
import type { AuditEntry } from '#shared/client/http.generated.ts';
import { createActs, detailsOf, type ActFilter, type ActsApi } from './acts.ts';

const PAGE = 3;

function entry(id: number, more: Partial<AuditEntry> = {}): AuditEntry {
  return { id, act: 'ran', who: 'Anna', whom: '', about: '', atMs: 0, untilMs: 0, count: 1, ...more };
}

/** A gateway with a list that grows. */
function gateway() {
  const all: AuditEntry[] = [];
  const failures: unknown[] = [];
  const passes = (one: AuditEntry, { act, who }: ActFilter): boolean =>
    (act === '' || one.act === act) && (who === '' || one.who === who);
  const api: ActsApi = {
    read(filter, before = Infinity) {
      const found = all.filter((one) => one.id < before && passes(one, filter)).toReversed();
      const more = found.length > PAGE;
      return Promise.resolve({ entries: found.slice(0, PAGE), more, names: ['Anna', 'Ben'], problem: null });
    },
    file: () => Promise.reject(new Error('no gateway')),
  };
  return { all, failures, acts: createActs(api, (error) => failures.push(error)) };
}

const idsOf = ({ acts }: ReturnType<typeof gateway>): readonly number[] | undefined =>
  acts.store.getState().entries?.map(({ id }) => id);

test('older pages stay when what is new is read, and a gap drops them', async () => {
  const here = gateway();
  here.all.push(...[1, 2, 3, 4, 5].map((id) => entry(id)));
  await here.acts.refresh();
  expect(idsOf(here)).toEqual([5, 4, 3]);
  expect(here.acts.store.getState().hasOlder).toBe(true);
  await here.acts.showOlder();
  expect(idsOf(here)).toEqual([5, 4, 3, 2, 1]);
  here.all[4] = entry(5, { count: 2 });
  here.all.push(entry(6));
  await here.acts.refresh();
  expect(idsOf(here)).toEqual([6, 5, 4, 3, 2, 1]);
  expect(here.acts.store.getState()).toMatchObject({ hasOlder: false, entries: { 1: { count: 2 } } });
  here.all.push(...[7, 8, 9, 10].map((id) => entry(id)));
  await here.acts.refresh();
  expect(idsOf(here)).toEqual([10, 9, 8]);
  expect(here.acts.store.getState().hasOlder).toBe(true);
});

test('a filter reads anew, and what was read under another is dropped', async () => {
  const here = gateway();
  here.all.push(entry(1), entry(2, { who: 'Ben' }), entry(3, { act: 'stopped' }));
  const late = here.acts.refresh();
  await here.acts.setFilter({ act: '', who: 'Ben' });
  await late;
  expect(idsOf(here)).toEqual([2]);
  await here.acts.setFilter({ act: 'stopped', who: 'Ben' });
  expect(idsOf(here)).toEqual([]);
});

test('a file that cannot be read is reported', async () => {
  const here = gateway();
  expect(await here.acts.file()).toBeNull();
  expect(here.failures).toHaveLength(1);
});

test.each([
  [entry(1, { about: '5' }), 'slot 5'],
  [entry(1, { act: 'calibrated', about: '2' }), 'servo 2'],
  [entry(1, { act: 'stopped', about: 'silence' }), 'the driver was not heard'],
  [entry(1, { act: 'roleChanged', whom: 'Ben', about: 'driver' }), 'Ben · Driver'],
  [entry(1, { act: 'portOpened', about: '/dev/ttyUSB0' }), '/dev/ttyUSB0'],
  [entry(1, { act: 'resumed' }), ''],
])('the details of %j', (one, expected) => {
  expect(detailsOf(one)).toBe(expected);
});

test('a repeated act says how often, and until when', () => {
  const untilMs = new Date(2026, 8, 21, 14, 5).valueOf();
  const moved = entry(1, { act: 'moved', count: 3, atMs: untilMs - 60_000, untilMs });
  expect(detailsOf(moved)).toBe('3 times · until 14:05');
  expect(detailsOf({ ...moved, atMs: 0 })).toBe('3 times · until Sep 21, 2026, 14:05');
});
