import { compileSource } from '../compile/compileSource.ts';
import { describe, expect, test } from 'vitest';
import { recordOf } from '#shared/group/slotBook.ts';
import { createTestPage } from '../../pageUnderTest.ts';
import { createSharedSlots, storedGroup } from './sharedSlotsUnderTest.ts';
import { downloadedSentence, downloadCancelled, errorSentence } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/words.ts';
import type { Way } from '../../../robot/device.ts';

const USB: Way = { kind: 'webSerial', label: 'USB 1A86:7523', isSimulated: false };
const at = (position: number) => [{ durationMs: 400, targets: [{ servo: 1, position }] }];
const WAVE = { slot: 5, name: 'Wave', documentId: 'wave', frames: at(1000) };
const BOW = { slot: 9, name: 'Bow', documentId: 'bow', frames: [...at(1200), ...at(1400)] };

async function openTestPage(...args: Parameters<typeof createTestPage>) {
  const page = await createTestPage(...args);
  const state = () => page.slots.store.getState();
  const stored = () => state().book.stored.map(({ slot, name }) => `${slot} ${name}`);
  return { ...page, state, stored };
}

describe('the slots of a board', () => {
  test('several groups are downloaded one after the other with one progress', async () => {
    const { slots, device, stored, draw, noticeTexts, channel } = await openTestPage();
    const heard: boolean[] = [];
    const activity = () => device.store.getState().snapshot.activity;
    slots.download([WAVE, BOW], (isDone) => void heard.push(isDone));
    await draw(400);
    expect(activity()).toMatchObject({ slots: [5, 9], groupsStored: 1, framesStored: 1, frameCount: 3 });
    expect(stored()).toEqual(['5 Wave']);
    await draw(4000);
    expect(activity()).toEqual({ kind: 'idle' });
    expect(noticeTexts()).toEqual([downloadedSentence([5, 9])]);
    expect(heard).toEqual([true]);
    expect(stored()).toEqual(['5 Wave', '9 Bow']);
    expect(channel.board.frameCount(9)).toBe(2);
  });

  test('what is called off ends the others too, and is not in the book', async () => {
    const { slots, stored, draw, noticeTexts } = await openTestPage();
    const heard: boolean[] = [];
    slots.download([BOW, WAVE], (isDone) => void heard.push(isDone));
    await draw(40);
    slots.cancel();
    await draw(4000);
    expect(heard).toEqual([false]);
    expect(noticeTexts()).toEqual([downloadCancelled(9)]);
    expect(stored()).toEqual([]);
  });

  test('that a slot is broken is not said any longer once it is empty or whole again', async () => {
    for (const mend of ['erase', 'download'] as const) {
      const { slots, draw, noticeTexts } = await openTestPage();
      slots.download([BOW]);
      await draw(40);
      slots.cancel();
      await draw(4000);
      expect(noticeTexts()).toEqual([downloadCancelled(9)]);
      if (mend === 'erase') slots.erase();
      else slots.download([BOW]);
      await draw(4000);
      expect(noticeTexts()).toEqual([mend === 'erase' ? words.board.erased : downloadedSentence([9])]);
    }
  });

  test('called off in its last frame, a group is whole, and the next one is not begun', async () => {
    const { slots, stored, draw, noticeTexts, channel } = await openTestPage();
    const heard: boolean[] = [];
    slots.download([WAVE, BOW], (isDone) => void heard.push(isDone));
    await draw(40);
    slots.cancel();
    await draw(4000);
    expect(heard).toEqual([false]);
    expect(stored()).toEqual(['5 Wave']);
    expect(noticeTexts()).toEqual([downloadCancelled(null)]);
    expect(channel.board.frameCount(9)).toBe(0);
  });

  test('STOP ends them', async () => {
    const { slots, device, state, draw, channel } = await openTestPage();
    slots.download([WAVE, BOW]);
    await draw(40);
    device.halt();
    await draw(4000);
    expect(device.store.getState().snapshot.brokenSlots).toEqual([5]);
    expect(state().book.begun).toEqual([]);
    expect(channel.board.frameCount(9)).toBe(0);
  });

  test('an erase leaves every slot empty, and what it took comes back', async () => {
    const { slots, state, stored, draw, channel } = await openTestPage();
    slots.download([WAVE, BOW]);
    await draw(4000);
    slots.erase();
    await draw(1000);
    expect(stored()).toEqual([]);
    expect(state().book.isEmptied).toBe(true);
    expect(channel.board.frameCount(5)).toBe(0);
    slots.restoreAll();
    await draw(4000);
    expect(stored()).toEqual(['5 Wave', '9 Bow']);
    expect(state().book.erased).toEqual([]);
    expect(channel.board.storedFrame(9, 1)).toEqual(BOW.frames[1]);
  });

  test('after an erase that the board did not answer what is left is unknown', async () => {
    const { slots, state, stored, draw } = await openTestPage(new Map(), {
      faults: [{ name: 'lostAck', nth: 2 }],
    });
    slots.download([WAVE]);
    await draw(4000);
    slots.erase();
    await draw(3000);
    expect(stored()).toEqual([]);
    expect(state().book.isEmptied).toBe(false);
    expect(state().book.erased.map(({ name }) => name)).toEqual(['Wave']);
  });

  test('an erase that was refused takes nothing from the book', async () => {
    const { slots, device, stored, draw } = await openTestPage();
    slots.download([WAVE]);
    await draw(4000);
    device.halt();
    await draw(500);
    slots.erase();
    await draw(1000);
    expect(stored()).toEqual(['5 Wave']);
  });

  test('are remembered for a board at its port, not for another one, and not for one in the page', async () => {
    const texts = new Map<string, string>();
    const first = await openTestPage(texts, { way: USB });
    first.slots.download([WAVE]);
    await first.draw(4000);
    const later = await openTestPage(texts, { way: USB });
    expect(later.stored()).toEqual(['5 Wave']);
    expect(recordOf(later.state().book, 5)?.frames).toEqual(WAVE.frames);
    expect((await openTestPage(texts, { way: { ...USB, label: 'USB 0001:0002' } })).stored()).toEqual([]);

    const inPage = await openTestPage(texts);
    inPage.slots.download([BOW]);
    await inPage.draw(4000);
    expect(inPage.stored()).toEqual(['9 Bow']);
    expect((await openTestPage(texts)).stored()).toEqual([]);
  });

  test('what was on its way when the page went is noted once it is there, or forgotten where it broke', async () => {
    for (const breaks of [false, true]) {
      const texts = new Map<string, string>();
      const first = await openTestPage(texts, { way: USB });
      first.slots.download([BOW]);
      await first.draw(40);
      expect(first.state().book.begun).toMatchObject([{ slot: 9, name: 'Bow' }]);
      const slotMemory = { read: () => (breaks ? [9] : []), write: () => undefined };
      const later = await openTestPage(texts, { way: USB, slotMemory });
      expect(later.stored()).toEqual(breaks ? [] : ['9 Bow']);
      expect(later.noticeTexts()).toEqual(breaks ? [] : [downloadedSentence([9])]);
      expect(later.state().book.begun).toEqual([]);
    }
  });

  test('of several that were on their way, each is noted that had arrived', async () => {
    const texts = new Map<string, string>();
    const first = await openTestPage(texts, { way: USB });
    first.slots.download([WAVE, BOW]);
    await first.draw(400);
    expect(first.state().book.begun).toMatchObject([{ slot: 9 }]);
    const later = await openTestPage(texts, {
      way: USB,
      slotMemory: { read: () => [9], write: () => undefined },
    });
    expect(later.stored()).toEqual(['5 Wave']);
    expect(later.state().book.begun).toEqual([]);
  });

  test('what another client stores in a slot makes it unknown', async () => {
    const { slots, device, stored, draw } = await openTestPage();
    slots.download([WAVE, BOW]);
    await draw(4000);
    device.download([{ slot: 5, frames: at(1700) }]);
    await draw(4000);
    expect(stored()).toEqual(['9 Bow']);
  });

  test('what another client stored while this page was away makes it unknown when it is back', async () => {
    const texts = new Map<string, string>();
    const gateway = createSharedSlots();
    const way: Way = { kind: 'gateway', label: '/dev/board', isSimulated: false };
    const { share, othersStore } = gateway;
    const first = await openTestPage(texts, { way, share });
    first.slots.download([WAVE, BOW]);
    await first.draw(100);
    expect(first.stored()).toEqual(['5 Wave', '9 Bow']);
    othersStore(5, { version: 'of Bert' }, false);
    expect((await openTestPage(texts, { way, share })).stored()).toEqual(['9 Bow']);
  });

  test('what another client stores while it looks on does so at once, what one has seen is reported with a download', async () => {
    const { share, othersStore, requested } = createSharedSlots({ 5: storedGroup({ version: 'of Bert' }) });
    const { slots, stored, draw, noticeTexts } = await openTestPage(new Map(), { way: USB, share });
    slots.download([WAVE, BOW]);
    await draw(100);
    expect(requested.map(({ slot, replaces }) => [slot, replaces])).toEqual([
      [5, 'of Bert'],
      [9, ''],
    ]);
    othersStore(9, { version: 'of Bert' });
    expect(stored()).toEqual(['5 Wave']);
    slots.download([{ ...BOW, replaces: 'seen before' }]);
    await draw(100);
    expect(noticeTexts()).toContain(errorSentence('slotChanged', ''));
    expect(stored()).toEqual(['5 Wave']);
  });

  test('another trim makes the copy another motion', async () => {
    const { slots, robots, compiled, document, state, draw } = await openTestPage();
    document.edit(
      () => 'write',
      (group) => ({
        ...group,
        name: 'Wave',
        nextId: 2,
        frames: [{ id: 1, easing: 'linear', note: '', colour: null, ...WAVE.frames[0]! }],
      }),
    );
    slots.download([{ ...WAVE, frames: compiled.now(compileSource).frames }]);
    await draw(4000);
    expect(recordOf(state().book, 5)?.fingerprint).toBe(compiled.now(compileSource).fingerprint);
    robots.edit(
      () => 'trim',
      (robot) => ({
        ...robot,
        servos: robot.servos.map((servo) => ({ ...servo, min: 700, max: 2300, trim: 30 })),
      }),
    );
    expect(recordOf(state().book, 5)?.fingerprint).not.toBe(compiled.now(compileSource).fingerprint);
  });
});
