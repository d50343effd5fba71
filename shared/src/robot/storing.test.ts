// Several groups in one download on a link of one's own: their order, one progress, and what each slot holds at the end.

import { describe, expect, test } from 'vitest';
import type { Activity } from './state.ts';
import { createRig, type Rig } from './rig.ts';

const at = (position: number) => [{ durationMs: 200, targets: [{ servo: 1, position }] }];
const WAVE = { slot: 5, frames: [...at(1_000), ...at(1_100)] };
const BOW = { slot: 9, frames: [...at(1_200), ...at(1_300), ...at(1_400)] };
const NOD = { slot: 2, frames: at(1_500) };
const SLOTS = [5, 9, 2];

const framesHeard = (rig: Rig): readonly string[] =>
  rig.ofKind('download').map(({ slot, frameIndex }) => `${slot}:${frameIndex}`);

/** Until as many groups are stored. */
async function untilStored(rig: Rig, count: number): Promise<void> {
  const stored = (): number => {
    const { activity } = rig.session.state;
    return activity.kind === 'downloading' ? activity.groupsStored : 0;
  };
  while (stored() < count) await rig.clock.advance(5);
}

describe('several groups', () => {
  test('are stored one after the other with one progress', async () => {
    const rig = await createRig();
    const seen: Extract<Activity, { kind: 'downloading' }>[] = [];
    rig.session.subscribe({
      state: ({ activity }) => activity.kind === 'downloading' && seen.push(activity),
    });
    const done = rig.session.download([WAVE, BOW, NOD]);
    await rig.clock.advance(5_000);
    await done;
    expect(framesHeard(rig)).toEqual(['5:0', '5:1', '9:0', '9:1', '9:2', '2:0']);
    expect([...new Set(seen.map(({ framesStored }) => framesStored))]).toEqual([0, 1, 2, 3, 4, 5, 6]);
    expect([...new Set(seen.map(({ slot }) => slot))]).toEqual(SLOTS);
    expect(new Set(seen.map(({ frameCount, bytesTotal }) => `${frameCount} ${bytesTotal}`)).size).toBe(1);
    expect(seen.every(({ remainingMs, framesStored }) => remainingMs > 0 || framesStored === 6)).toBe(true);
    expect(rig.session.state).toMatchObject({
      ...{ activity: { kind: 'idle' }, brokenSlots: [], storedSlots: [2, 5, 9] },
      lastDownload: { slots: SLOTS, groupsStored: 3 },
    });
    expect(rig.channel.board.storedFrame(9, 2)).toEqual(BOW.frames[2]);
  });

  test('that STOP ends leave whole ones before it and old ones behind it', async () => {
    const rig = await createRig();
    const done = rig.session.download([WAVE, BOW, NOD]).catch((error: unknown) => error);
    await untilStored(rig, 1);
    await rig.clock.advance(50);
    void rig.session.halt();
    await rig.clock.advance(5_000);
    expect(await done).toMatchObject({ code: 'latched' });
    expect(rig.session.state).toMatchObject({
      ...{ brokenSlots: [9], storedSlots: [5], lastDownload: { slots: SLOTS, groupsStored: 1 } },
    });
    expect(framesHeard(rig)).not.toContain('2:0');
  });

  test('called off in the last frame of one, none is broken and the next is not begun', async () => {
    const rig = await createRig();
    const done = rig.session.download([WAVE, BOW]).catch((error: unknown) => error);
    while (!framesHeard(rig).includes('5:1')) await rig.clock.advance(1);
    void rig.session.cancelDownload();
    await rig.clock.advance(5_000);
    expect(await done).toMatchObject({ code: 'cancelled' });
    expect(framesHeard(rig)).toEqual(['5:0', '5:1']);
    expect(rig.session.state).toMatchObject({ brokenSlots: [], lastDownload: { groupsStored: 1 } });
  });

  test('are refused where two want one slot or the board cannot take one of them, before anything is sent', async () => {
    const rig = await createRig();
    const bad = { slot: 3, frames: at(9_000) };
    for (const groups of [
      [WAVE, BOW, { ...NOD, slot: 5 }],
      [WAVE, bad],
    ])
      await expect(rig.session.download(groups)).rejects.toMatchObject({ code: 'outOfRange' });
    expect(framesHeard(rig)).toEqual([]);
    expect(rig.session.state).toMatchObject({ activity: { kind: 'idle' }, lastDownload: null });
  });
});
