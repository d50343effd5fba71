import { describe, expect, test } from 'vitest';
import { makeBlock } from '#shared/group/blockEdits.ts';
import { blocksOf, motionTracks } from '#shared/group/blocks.ts';
import { startHistory } from '#shared/document/history.ts';
import { emptyGroup, totalDurationMs } from '#shared/group/group.ts';
import { insertFrame, type NewFrame } from '#shared/group/groupEdits.ts';
import { positionAt, tracksOf } from '#shared/group/tracks.ts';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import { convertGroup } from '#shared/group/frameEdits.ts';
import { createTestPage } from '../../pageUnderTest.ts';
import { freeOf } from '../../servoView.ts';
import { editServoView } from '../../stores.ts';
import { over, RECORD_OVER } from './recordOver.ts';

const frame = (durationMs: number, one: number, two: number): NewFrame => ({
  durationMs,
  targets: [
    { servo: 1, position: one },
    { servo: 2, position: two },
  ],
});

/** Servo 1 goes to and fro each second, servo 2 stands at 1200. */
const WAVE = [
  frame(500, 1000, 1200),
  ...[1600, 1000, 1600, 1000].map((one) => frame(1000, one, 1200)),
].reduce((group, each) => insertFrame(group, group.frames.length, each), emptyGroup('Wave', 'us'));

const LEAD_MS = 1500;

async function armed(servos: readonly number[] = [2], id: FamilyId = 'doc') {
  const page = await createTestPage(new Map(), { family: FAMILIES[id] });
  page.document.edit(
    () => 'write',
    () => (FAMILIES[id].unit === 'us' ? WAVE : (convertGroup(WAVE, FAMILIES[id].unit) ?? WAVE)),
  );
  const { min, max } = FAMILIES[id].position;
  page.device.move(
    [
      { servo: 1, position: Math.round(min + (max - min) / 4) },
      { servo: 2, position: Math.round((min + max) / 2) },
    ],
    500,
  );
  await page.draw(3000);
  editServoView(page, (view) => ({ ...view, armed: servos }));
  const group = () => page.document.store.getState().present;
  return {
    ...page,
    group,
    press: () => RECORD_OVER.run(page),
    move: (position: number, durationMs: number) => page.device.move([{ servo: 2, position }], durationMs),
    at: (servo: number, atMs: number) => positionAt(tracksOf(group()).get(servo)!, atMs),
    keysOf: (servo: number) =>
      tracksOf(group())
        .get(servo)!
        .keys.map(({ atMs, position }) => [atMs, position]),
  };
}

describe('recording over the motion', () => {
  test('plays the others and leaves the armed servo to the user, whose motion replaces its keys in one step', async () => {
    const page = await armed();
    page.playhead.go(1000);
    const before = page.group();
    const sentBefore = page.moves().length;
    page.press();
    await page.draw(LEAD_MS + 500);
    expect(page.playback.store.getState().phase).toBe('recording');
    page.move(2000, 1000);
    await page.draw(4000);
    expect(page.playback.store.getState().phase).toBeNull();

    const targets = page
      .moves()
      .slice(sentBefore)
      .flatMap((move) => move.targets);
    // Packets of servo 1 carry it on its one way to 2000.
    const ofArmed = targets.filter(({ servo }) => servo === 2).map(({ position }) => position);
    expect(ofArmed.at(-1)).toBe(2000);
    expect(ofArmed.toSorted((one, other) => one - other)).toEqual(ofArmed);
    const played = targets.filter(({ servo }) => servo === 1).map(({ position }) => position);
    // Its way there is 1.5 s long and leaves in two parts.
    expect(played.slice(0, 2)).toEqual([1200, 1300]);
    expect(played.filter((position) => position === 1600 || position === 1000)).toEqual([
      1600, 1000, 1600, 1000,
    ]);
    for (const [atMs, position] of [
      [500, 1200],
      [1000, 1500],
      [1400, 1500],
      [2000, 1750],
      [2600, 2000],
      [4500, 2000],
    ] as const)
      expect(Math.abs((page.at(2, atMs) ?? NaN) - position), `at ${atMs}`).toBeLessThanOrEqual(45);
    for (const atMs of [500, 1000, 1250, 1500, 2200, 3333, 4500])
      expect(page.at(1, atMs)).toBeCloseTo(positionAt(tracksOf(before).get(1)!, atMs) ?? NaN, 0);
    expect(page.keysOf(2).length).toBeLessThan(9);
    expect(totalDurationMs(page.group().frames)).toBe(4500);

    page.document.undo();
    expect(page.group()).toBe(before);
  });

  test.for(['doc', 'bus-ctrl'] as const)(
    'on %s the armed servo follows a drag, however long the frames are that play beside it',
    async (id) => {
      const page = await armed([2], id);
      const { min, max } = page.device.store.getState().family.position;
      const span = max - min;
      const draggedTo = (ms: number): number => Math.round(min + span * (0.5 + 0.15 * Math.sin(ms / 250)));
      page.press();
      await page.draw(LEAD_MS + 100);
      const sentBefore = page.moves().length;
      for (let ms = 0; ms < 3000; ms += 20) {
        page.device.drag([{ servo: 2, position: draggedTo(ms) }], 'hand');
        await page.draw(20);
      }
      const sent = page.moves().slice(sentBefore);
      const own = sent.filter(({ targets }) => targets.some(({ servo }) => servo === 2));
      expect(Math.max(...own.map(({ durationMs }) => durationMs))).toBeLessThanOrEqual(100);
      const playedBeside = sent.filter(({ targets }) => targets.some(({ servo }) => servo === 1));
      expect(playedBeside.length).toBeGreaterThan(20);
      await page.draw(3000);
      // The take began with the lead's end, 100 ms before the drag.
      for (const ms of [600, 1100, 1800, 2500])
        expect(Math.abs((page.at(2, 600 + ms) ?? NaN) - draggedTo(ms)), `at ${ms}`).toBeLessThanOrEqual(
          0.1 * span,
        );
    },
  );

  test('a servo whose first key comes late is there before, gently, and does not leap to it', async () => {
    const page = await armed();
    const late = [{ servo: 3, position: 2300 }];
    page.device.move([{ servo: 3, position: 1500 }], 500);
    await page.draw(2500);
    page.document.edit(
      () => 'write',
      (group) => insertFrame(group, group.frames.length, { durationMs: 1000, targets: late }),
    );
    const sentBefore = page.moves().length;
    page.press();
    await page.draw(LEAD_MS + 7000);
    const sent = page.moves().slice(sentBefore);
    const own = sent.filter(({ targets }) => targets.some(({ servo }) => servo === 3));
    const places = own.map(({ targets }) => targets.find(({ servo }) => servo === 3)?.position);
    // The way of 1.5 s leaves in two parts, and it stays there.
    expect(own[0]?.durationMs).toBe(1000);
    expect(places.slice(0, 2)).toEqual([1500 + Math.round((800 * 1000) / LEAD_MS), 2300]);
    expect(new Set(places.slice(1))).toEqual(new Set([2300]));
  });

  test('what plays is locked meanwhile: a move of both moves only the armed servo', async () => {
    const page = await armed();
    const both = [1, 2].map((servo) => ({ servo, position: 1700 }));
    page.press();
    await page.draw(200);
    expect(freeOf(page, both)).toEqual([{ servo: 2, position: 1700 }]);
    await page.draw(LEAD_MS + 5000);
    expect(freeOf(page, both)).toEqual(both);
  });

  test('at half the speed it is at the same place of the group', async () => {
    const page = await armed();
    page.playback.set({ speedPercent: 50 });
    page.playhead.go(1000);
    page.press();
    await page.draw(LEAD_MS + 1000);
    page.move(2000, 2000);
    await page.draw(9000);
    expect(Math.abs((page.at(2, 2000) ?? NaN) - 1750)).toBeLessThanOrEqual(45);
    expect(page.at(2, 4500)).toBe(2000);
  });

  test('ended with the button it replaces as much as was played, and the marked part ends it by itself', async () => {
    const page = await armed();
    page.press();
    await page.draw(LEAD_MS + 500);
    page.move(2000, 300);
    await page.draw(1000);
    page.press();
    await page.draw(1000);
    expect(page.at(2, 1900)).toBeCloseTo(2000, 0);
    const later = page.keysOf(2).filter(([atMs]) => (atMs ?? 0) > 2050);
    expect(later).toEqual([
      [2500, 1200],
      [3500, 1200],
      [4500, 1200],
    ]);

    page.timeline.setState({ range: { fromMs: 3000, toMs: 4000 } });
    page.press();
    await page.draw(LEAD_MS + 200);
    page.move(1000, 300);
    await page.draw(1500);
    expect(page.at(2, 4000)).toBe(1000);
    expect(page.keysOf(2).filter(([atMs]) => (atMs ?? 0) < 3000 || (atMs ?? 0) > 4000)).toEqual([
      ...page.keysOf(2).filter(([atMs]) => (atMs ?? 0) < 2100),
      [2500, 1200],
      [4500, 1200],
    ]);
  });

  test.for([
    ['Stop', (page) => page.device.halt()],
    ['a lost link', (page) => page.session.close()],
    ['a hidden page', (page) => page.playback.hidden()],
    ['another group', (page) => page.opened.setState({ openId: 'other' })],
  ] as readonly (readonly [string, (page: Awaited<ReturnType<typeof armed>>) => unknown])[])(
    '%s ends both; the group is unchanged, and the tape still has the motion',
    async ([name, end]) => {
      const page = await armed();
      const before = page.group();
      page.press();
      await page.draw(LEAD_MS + 500);
      page.move(2000, 300);
      await page.draw(700);
      void end(page);
      await page.draw(6000);
      expect(page.playback.store.getState().phase).toBeNull();
      expect(page.group()).toBe(before);
      expect(page.noticeTexts().join(), name).toContain('ended early');
      expect(freeOf(page, [{ servo: 1, position: 1700 }])).toHaveLength(1);
      expect(page.tape.takeThat().some(({ servo, position }) => servo === 2 && position === 2000)).toBe(true);
    },
  );

  test('where no armed servo moved it changes nothing and says so; without armed rows it does not begin', async () => {
    const page = await armed();
    const before = page.group();
    page.press();
    await page.draw(LEAD_MS + 6000);
    expect(page.group()).toBe(before);
    expect(page.noticeTexts()).toContain('Nothing moved.');
    editServoView(page, (view) => ({ ...view, armed: [] }));
    expect(RECORD_OVER.enabled(page)).toBe('Arm a row first, in its menu.');
    editServoView(page, (view) => ({ ...view, armed: [2, 3] }));
    expect(RECORD_OVER.enabled(page)).toMatch(/^Move the armed servos first.*: Wrist\.$/);
  });

  test('with every row armed nothing is sent, and the playhead still runs for the recording', async () => {
    const page = await armed([1, 2]);
    const sentBefore = page.moves().length;
    page.document.store.setState(startHistory(WAVE));
    page.press();
    await page.draw(LEAD_MS + 1000);
    expect(page.moves()).toHaveLength(sentBefore);
    page.move(2000, 500);
    await page.draw(5000);
    expect([page.at(1, 4500), page.at(2, 4500)]).toEqual([1000, 2000]);
  });
});

test('what is recorded counts also where a block moved that servo, and the other blocks stay', () => {
  const keys = (servo: number) => WAVE.frames.map(({ id: frameId }) => ({ frameId, servo }));
  const blocks = makeBlock(makeBlock(WAVE, keys(1), 'Wave')!, keys(2), 'Stand')!;
  const take = insertFrame(
    insertFrame(emptyGroup('', 'us'), 0, { durationMs: 1000, targets: [{ servo: 2, position: 2000 }] }),
    1,
    { durationMs: 500, targets: [{ servo: 2, position: 2200 }] },
  );
  const after = over(blocks, take, 1000);
  expect(blocksOf(after).map(({ name }) => name)).toEqual(['Wave']);
  const motion = motionTracks(after);
  expect(positionAt(motion.get(2)!, 1000)).toBe(2000);
  expect(positionAt(motion.get(2)!, 1500)).toBe(2200);
  for (const atMs of [500, 1000, 2000, 3500])
    expect(positionAt(motion.get(1)!, atMs)).toBe(positionAt(tracksOf(WAVE).get(1)!, atMs));
});
