import fc from 'fast-check';
import { expect, test } from 'vitest';
import { isLiveSlot } from '#shared/codec/families.ts';
import { TIMES } from '#shared/testing/cases.ts';
import { createTestPage } from '../../pageUnderTest.ts';
import type { ReplaceAnswer } from './replacing.ts';

const groupAt = (documentId: string, slot: number, position: number) => ({
  ...{ slot, documentId, name: documentId },
  frames: [{ durationMs: 200, targets: [{ servo: 1, position }] }],
});
type Group = ReturnType<typeof groupAt>;

async function openTestPage(...stored: readonly Group[]) {
  const page = await createTestPage();
  const { slots, replacing, ofKind, draw } = page;
  slots.download(stored);
  await draw(3000);
  const before = ofKind('download').length;
  return {
    ...page,
    question: () => replacing.store.getState().question,
    /** Slots that frames have gone to, since the desk was opened. */
    sent: () =>
      ofKind('download')
        .slice(before)
        .map(({ slot }) => slot),
  };
}

test('nothing leaves for a slot that holds another group before the answer; left, it stays', async () => {
  const { replacing, question, sent, draw } = await openTestPage(groupAt('bow', 2, 1000));
  const heard: boolean[] = [];
  replacing.download([groupAt('wave', 2, 1200)], { settled: (isDone) => void heard.push(isDone) });
  await draw(5000);
  expect(question()).toMatchObject({
    conflicts: [{ slot: 2, held: 'bow', heldId: 'bow', name: 'wave' }],
    free: [21],
  });
  expect([sent(), heard]).toEqual([[], []]);
  replacing.answer('leave');
  await draw(5000);
  expect([question(), sent(), heard]).toEqual([null, [], [false]]);
});

test('of several groups those that would replace another one go to free slots, the others to theirs', async () => {
  const { replacing, question, sent, draw } = await openTestPage(
    groupAt('bow', 2, 1000),
    groupAt('nod', 3, 1100),
  );
  const began: number[] = [];
  const groups = [groupAt('wave', 3, 1200), groupAt('jump', 21, 1300), groupAt('sit', 2, 1400)];
  replacing.download(groups, { began: (to) => began.push(...to.map(({ slot }) => slot)) });
  expect(question()?.free).toEqual([22, 23]);
  replacing.answer('free');
  await draw(5000);
  expect([sent(), began]).toEqual([
    [22, 21, 23],
    [22, 21, 23],
  ]);
});

test('an older version of the same group, the same motion and what is empty are not asked about', async () => {
  const { replacing, question, sent, draw } = await openTestPage(
    groupAt('bow', 2, 1000),
    groupAt('nod', 3, 1100),
  );
  replacing.download([groupAt('bow', 2, 1050), groupAt('copy of nod', 3, 1100), groupAt('sit', 30, 1400)]);
  await draw(5000);
  expect([question(), sent()]).toEqual([null, [2, 3, 30]]);
});

test('no group goes from the board but by the answer that names it', async () => {
  const someGroup = fc.record({
    slot: fc.integer({ min: 0, max: 255 }),
    position: fc.integer({ min: 900, max: 904 }),
  });
  const some = (maxLength: number) =>
    fc.uniqueArray(someGroup, { minLength: 1, maxLength, selector: ({ slot }) => slot });
  const close = some(4).map((groups) => groups.map((group) => ({ ...group, slot: group.slot % 4 })));
  const distinct = (groups: readonly { slot: number; position: number }[]) => [
    ...new Map(groups.map((group) => [group.slot, group])).values(),
  ];
  await fc.assert(
    fc.asyncProperty(
      ...([close, close, fc.constantFrom<ReplaceAnswer>('replace', 'free', 'leave')] as const),
      async (first, second, answered) => {
        const held = distinct(first).map(({ slot, position }) => groupAt(`held ${slot}`, slot, position));
        const { replacing, question, sent, draw, slots } = await openTestPage(...held);
        replacing.download(distinct(second).map(({ slot, position }) => groupAt('new', slot, position)));
        const requested = question()?.conflicts.map(({ slot }) => slot) ?? [];
        expect(question()?.free?.some(isLiveSlot) ?? false).toBe(false);
        await draw(100);
        if (requested.length > 0) expect(sent()).toEqual([]);
        replacing.answer(answered);
        await draw(8000);
        const { stored } = slots.store.getState().book;
        const gone = held.filter(({ slot, frames }) => {
          const now = stored.find((record) => record.slot === slot);
          return now?.frames[0]?.targets[0]?.position !== frames[0]?.targets[0]?.position;
        });
        expect(
          gone.map(({ slot }) => slot).filter((slot) => answered !== 'replace' || !requested.includes(slot)),
        ).toEqual([]);
        if (answered === 'leave' && requested.length > 0) expect(sent()).toEqual([]);
        if (answered === 'free') for (const slot of sent()) expect(requested).not.toContain(slot);
      },
    ),
    { numRuns: 12 * TIMES },
  );
});
