import { compileSource } from '../compile/compileSource.ts';
import { expect, test } from 'vitest';
import { emptyGroup } from '#shared/group/group.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { slotFor } from '#shared/group/slotPlaces.ts';
import { EMPTY_SLOT_BOOK } from '#shared/group/slotBook.ts';
import { createTestPage } from '../../pageUnderTest.ts';
import { downloadOf, hindranceOf, thoseThatCan, type Wanted } from './SeveralGroups.tsx';

test('what does not fit, is empty or wants the slot of another is reported; the rest can be downloaded', async () => {
  const { compiled, device, robots } = await createTestPage();
  const on = { family: device.store.getState().family, robot: robots.current().robot };
  const wantedOf = (documentId: string, slot: number, ...positions: readonly number[]): Wanted => {
    const group = positions.reduce(
      (sum, position) => insertFrame(sum, 9, { durationMs: 400, targets: [{ servo: 1, position }] }),
      emptyGroup(documentId, 'us'),
    );
    return { documentId, slot, compiled: compiled.of(group, on, compileSource) };
  };
  const [wave, bow, far, none] = [
    wantedOf('wave', 1, 1000, 1200),
    wantedOf('bow', 2, 1000),
    wantedOf('far', 3, 2600),
    wantedOf('none', 4),
  ];
  const hindrances = [wave, bow, far, none].map((one) => hindranceOf(one, [wave, bow, far, none]));
  expect(hindrances.map((text) => text !== null)).toEqual([false, false, true, true]);
  expect(hindranceOf(bow, [{ ...wave, slot: 2 }, bow])).toBe('Slot 2 is chosen twice.');
  expect(downloadOf(wave)).toMatchObject({ documentId: 'wave', slot: 1, name: 'wave', frames: [{}, {}] });
});

test('of all groups those are taken that can go, each in its slot or a free one, and no two in the same', async () => {
  const { compiled, device, robots } = await createTestPage();
  const on = { family: device.store.getState().family, robot: robots.current().robot };
  const requested = (documentId: string, slot: number | null, ...positions: readonly number[]) => {
    const group = positions.reduce(
      (sum, position) => insertFrame(sum, 9, { durationMs: 400, targets: [{ servo: 1, position }] }),
      emptyGroup(documentId, 'us'),
    );
    return { documentId, compiled: compiled.of(group, on, compileSource), own: slot };
  };
  const known = { book: EMPTY_SLOT_BOOK, versions: {}, broken: [], range: { min: 0, max: 23 } };
  const slotsOf = (all: readonly Wanted[]) => all.map(({ documentId, slot }) => `${documentId} ${slot}`);
  const { can, cannot } = thoseThatCan(
    [
      requested('free', null, 1000),
      requested('far', null, 2600),
      requested('bow', 2, 1000),
      requested('second', 2, 1200),
    ],
    [{ ...requested('wave', 0, 1000), slot: 0 }],
    (own, taken) => slotFor(own, known, taken),
  );
  expect(slotsOf(can)).toEqual(['bow 2', 'free 21']);
  expect(slotsOf(cannot)).toEqual(['second 2', 'far 22']);
  expect(cannot.map((one) => hindranceOf(one, can) === null)).toEqual([false, false]);
});
