import { describe, expect, test } from 'vitest';
import { CAPACITY } from '#shared/files/recording.ts';
import { createTrafficLog, type LogEntry } from '../../robot/traffic.ts';
import { createLogView } from './logView.ts';

/** A log in which every second packet is a stop, the others ask for the battery. */
function createLog(count: number) {
  const log = createTrafficLog();
  let atMs = 0;
  const add = (): void => {
    atMs += 1;
    const command = atMs % 2 === 0 ? ({ kind: 'stop' } as const) : ({ kind: 'readBattery' } as const);
    const bytes = Uint8Array.of(0x55, 0x55, 2, atMs % 2 === 0 ? 7 : 15);
    log.add({ atMs, direction: 'out', bytes, command }, 'doc');
  };
  for (let index = 0; index < count; index++) add();
  return { log, add };
}

const isStop = ({ entry }: LogEntry): boolean => 'bytes' in entry && entry.bytes[3] === 7;
const always = (): boolean => true;
const times = (entries: readonly LogEntry[]): number[] => entries.map(({ entry }) => entry.atMs);

describe('what is looked at', () => {
  test('is what passes, with the rest counted', () => {
    const { log } = createLog(5);
    const { shown, passedCount, hiddenCount } = createLogView(log, isStop).getSnapshot();
    expect(times(shown)).toEqual([2, 4]);
    expect([passedCount, hiddenCount]).toEqual([2, 3]);
  });

  test('grows with the log, and each entry is read once', () => {
    const { log, add } = createLog(3);
    const requested: number[] = [];
    const view = createLogView(log, ({ id }) => requested.push(id) > 0);
    let changes = 0;
    view.subscribe(() => (changes += 1));
    add();
    add();
    expect(times(view.getSnapshot().shown)).toEqual([1, 2, 3, 4, 5]);
    expect(requested).toEqual([1, 2, 3, 4, 5]);
    expect(changes).toBe(2);
  });

  test('stays the same value while nothing changes', () => {
    const view = createLogView(createLog(3).log, always);
    expect(view.getSnapshot()).toBe(view.getSnapshot());
  });

  test('misses nothing that came before it was listened to', () => {
    const { log, add } = createLog(1);
    const view = createLogView(log, always);
    add();
    view.subscribe(() => undefined);
    expect(times(view.getSnapshot().shown)).toEqual([1, 2]);
  });

  test('held, it ends where it was held', () => {
    const { log, add } = createLog(3);
    const view = createLogView(log, always, log.store.getState().nextId);
    view.subscribe(() => undefined);
    add();
    expect(times(view.getSnapshot().shown)).toEqual([1, 2, 3]);
  });

  test('shows the newest 200 of a log that keeps 20,000', () => {
    const { log, add } = createLog(CAPACITY + 10);
    const view = createLogView(log, isStop);
    view.subscribe(() => undefined);
    add();
    add();
    const { shown, passedCount, hiddenCount } = view.getSnapshot();
    expect(shown).toHaveLength(200);
    expect(shown.at(-1)?.entry.atMs).toBe(CAPACITY + 12);
    expect(passedCount + hiddenCount).toBe(CAPACITY);
  });

  test('is empty after the log was cleared', () => {
    const { log, add } = createLog(4);
    const view = createLogView(log, always);
    view.subscribe(() => undefined);
    log.clear();
    expect(view.getSnapshot()).toEqual({ shown: [], passedCount: 0, hiddenCount: 0 });
    add();
    expect(times(view.getSnapshot().shown)).toEqual([5]);
  });
});
