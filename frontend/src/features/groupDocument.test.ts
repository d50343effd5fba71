import { describe, expect, test } from 'vitest';
import { insertFrame, moveFrames } from '#shared/group/groupEdits.ts';
import { setDuration } from '#shared/group/timeEdits.ts';
import { groupFromText } from '#shared/group/group.ts';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { words } from '../i18n/words.ts';
import { createDocument } from './groupDocument.ts';
import type { TextStorage } from '../state/storage.ts';
import { createNotices } from '../state/notices.ts';

const FRAME = { durationMs: 500, targets: [{ servo: 1, position: 1500 }] };

function createTestPage(texts: Record<string, string> = {}, broken: Partial<TextStorage> = {}) {
  const stored = new Map(Object.entries(texts));
  const storage: TextStorage = {
    getItem: (key) => stored.get(key) ?? null,
    setItem: (key, text) => void stored.set(key, text),
    ...broken,
  };
  const clock = createVirtualClock();
  const notices = createNotices(clock);
  const document = createDocument(storage, notices, clock);
  /** What the page finds when it is opened again. */
  const saved = () => {
    document.flush();
    const read = groupFromText(stored.get('servodeck.group') ?? '');
    return 'value' in read ? read.value : null;
  };
  const noticeTexts = () => notices.store.getState().map((notice) => notice.text);
  return {
    document,
    stored,
    storage,
    saved,
    noticeTexts,
    clock,
    group: () => document.store.getState().present,
  };
}

describe('the document', () => {
  test('is saved after each edit, undo and redo, and found again', () => {
    const { document, storage, saved } = createTestPage();
    document.edit(
      () => 'capture',
      (group) => insertFrame(group, 0, FRAME),
    );
    document.edit(
      () => 'capture',
      (group) => insertFrame(group, 1, FRAME),
    );
    expect(saved()!.frames).toHaveLength(2);
    document.undo();
    expect(saved()!.frames).toHaveLength(1);
    document.redo();
    expect(saved()!.frames).toHaveLength(2);
    const later = createVirtualClock();
    const again = createDocument(storage, createNotices(later), later);
    expect(again.store.getState().present.frames).toHaveLength(2);
  });

  test('a crash loses no more than the last frame that was drawn', async () => {
    const written: string[] = [];
    const { document, clock } = createTestPage({}, { setItem: (_, text) => void written.push(text) });
    const add = () =>
      document.edit(
        () => 'capture',
        (group) => insertFrame(group, 0, FRAME),
      );
    add();
    add();
    expect(written).toHaveLength(0);
    await clock.advance(16);
    expect(written).toHaveLength(1);
    add();
    await clock.advance(16);
    expect(written).toHaveLength(2);
    await clock.advance(1000);
    expect(written).toHaveLength(2);
    add();
    document.flush();
    document.flush();
    await clock.advance(1000);
    expect(written).toHaveLength(3);
    expect(written[2]).toContain('"nextId":5');
  });

  test('what a drag shows is not saved by an edit that came before it', async () => {
    const { document, saved, clock } = createTestPage();
    document.edit(
      () => 'capture',
      (group) => insertFrame(group, 0, FRAME),
    );
    document.begin(() => 'move');
    document.preview((group) => insertFrame(group, 1, FRAME));
    await clock.advance(1000);
    expect(saved()!.frames).toHaveLength(1);
  });

  test('a drag is one step, saved once it ends', () => {
    const { document, saved, group } = createTestPage();
    for (const at of [0, 1, 2])
      document.edit(
        () => 'capture',
        (before) => insertFrame(before, at, FRAME),
      );
    document.begin(() => 'move');
    document.preview((before) => moveFrames(before, [1], 1, 1));
    document.preview((before) => moveFrames(before, [1], 1, 2));
    expect(group().frames.map((frame) => frame.id)).toEqual([2, 3, 1]);
    document.commit();
    document.undo();
    expect(group().frames.map((frame) => frame.id)).toEqual([1, 2, 3]);
    expect(saved()!.frames).toHaveLength(3);
  });

  test('a cancelled drag leaves everything as it was', () => {
    const { document, group } = createTestPage();
    for (const at of [0, 1])
      document.edit(
        () => 'capture',
        (before) => insertFrame(before, at, FRAME),
      );
    const before = group();
    document.begin(() => 'move');
    document.preview((current) => moveFrames(current, [1], 1, 1));
    document.cancel();
    expect(group()).toBe(before);
  });

  test('an edit that changes nothing is no step', () => {
    const { document } = createTestPage();
    document.edit(
      () => 'capture',
      (group) => insertFrame(group, 0, FRAME),
    );
    document.edit(
      () => 'time',
      (group) => setDuration(group, 1, 500, { ripple: true }),
    );
    expect(document.store.getState().past).toHaveLength(1);
  });

  test('text that cannot be read is set aside unharmed, and a notice says so', () => {
    const { group, stored, noticeTexts } = createTestPage({ 'servodeck.group': '{"version":9}' });
    expect(group().frames).toHaveLength(0);
    expect(stored.get('servodeck.group.unreadable')).toBe('{"version":9}');
    expect(noticeTexts()).toEqual([words.actions.broken]);
  });

  test('a browser that stores nothing is reported once; editing goes on', () => {
    const refuse = (): never => {
      throw new Error('storage is forbidden');
    };
    const { document, group, noticeTexts } = createTestPage({}, { getItem: refuse, setItem: refuse });
    document.edit(
      () => 'capture',
      (before) => insertFrame(before, 0, FRAME),
    );
    document.flush();
    document.edit(
      () => 'capture',
      (before) => insertFrame(before, 0, FRAME),
    );
    document.flush();
    expect(group().frames).toHaveLength(2);
    expect(noticeTexts()).toEqual([words.actions.notSaved]);
  });

  test('a browser that stores again has it said no longer', () => {
    let isFull = true;
    const setItem = (): void => {
      if (isFull) throw new Error('full');
    };
    const { document, noticeTexts } = createTestPage({}, { getItem: () => null, setItem });
    const capture = (): void => {
      document.edit(
        () => 'capture',
        (before) => insertFrame(before, 0, FRAME),
      );
      document.flush();
    };
    capture();
    expect(noticeTexts()).toEqual([words.actions.notSaved]);
    isFull = false;
    capture();
    expect(noticeTexts()).toEqual([]);
  });
});
