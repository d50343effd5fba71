import { describe, expect, test } from 'vitest';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import { isProfileName } from '#shared/simulator/profileNames.ts';
import { servoLabel } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import { captureFrame } from '../animate/frames/CaptureButton.tsx';
import { createTestPage } from '../pageUnderTest.ts';
import { canTeach, createTeaching } from './teaching.ts';

async function createXarm() {
  const page = await createTestPage(new Map(), { profile: 'xarm', family: FAMILIES.xarm });
  const teaching = createTeaching(page);
  const { board } = page.channel;
  return {
    ...{ ...page, teaching, board },
    isOn: () => teaching.store.getState().isOn,
    kinds: () => page.heard.map(({ command }) => command.kind),
    reads: () => page.ofKind('readPositions').length,
  };
}

/** Until a board has reported six servos (X7), and once more. */
const TWO_READS_MS = 1200;

describe('teaching by hand', () => {
  test('is for boards that can let go of their servos and tell where they stand', () => {
    const able = Object.values(FAMILIES).filter(canTeach);
    expect(able.map(({ id }) => id)).toEqual(['bus-ctrl', 'xarm'] satisfies FamilyId[]);
    expect(able.every(({ id }) => isProfileName(id))).toBe(true);
  });

  test('lets go once, then reads as often as the board answers, and what is read is the pose', async () => {
    const { teaching, board, draw, device, reads, kinds, isOn } = await createXarm();
    teaching.begin();
    await draw(TWO_READS_MS);
    expect([isOn(), kinds()[0]]).toEqual([true, 'release']);
    board.turn(2, 640);
    board.turn(3, 300);
    await draw(TWO_READS_MS);
    expect(device.pose().map(({ position }) => position)).toEqual([400, 640, 300, 400, 400, 400]);
    expect(device.motion(2)).toEqual({ target: 640, estimated: 640, reported: 'released' });
    expect(device.store.getState().known).toEqual([1, 2, 3, 4, 5, 6]);
    const before = reads();
    await draw(5000);
    expect(reads() - before).toBeGreaterThanOrEqual(9);
    expect(new Set(kinds())).toEqual(new Set(['release', 'readPositions']));
  });

  test('captures frames, and records the way', async () => {
    const page = await createXarm();
    const { teaching, board, draw, document, tape } = page;
    teaching.begin();
    await draw(TWO_READS_MS);
    captureFrame(page, 'end');
    tape.record();
    for (const position of [420, 480, 560]) {
      board.turn(1, position);
      await draw(TWO_READS_MS);
    }
    captureFrame(page, 'end');
    const { frames } = document.store.getState().present;
    expect(frames.map(({ targets }) => targets[0]?.position)).toEqual([400, 560]);
    expect(tape.end([1]).map(({ position }) => position)).toEqual(
      expect.arrayContaining([400, 420, 480, 560]),
    );
  });

  test('ends with a gentle hold of what was read last, which moves nothing', async () => {
    const { teaching, board, draw, ofKind, isOn, device } = await createXarm();
    teaching.begin();
    await draw(TWO_READS_MS);
    for (const servo of [1, 2, 3, 4, 5, 6]) board.turn(servo, 300 + 20 * servo);
    await draw(TWO_READS_MS);
    const before = board.snapshot().pulses;
    teaching.end();
    await draw(5000);
    expect(isOn()).toBe(false);
    expect(board.snapshot().pulses).toEqual(before);
    expect(board.snapshot().targets).toEqual(before);
    expect(ofKind('move').every(({ durationMs }) => durationMs >= 1500)).toBe(true);
    expect(device.motion(1)).toEqual({ target: 320, estimated: 320 });
    // They hold against a hand again.
    board.turn(1, 900);
    expect(board.pulse(1)).toBe(320);
  });

  test('leaves a servo released that was turned beyond its limits, and says which', async () => {
    const { teaching, board, draw, robots, noticeTexts, ofKind } = await createXarm();
    const { robot } = robots.current();
    robots.edit(
      () => 'limits',
      () => ({
        ...robot,
        servos: robot.servos.map((servo) => (servo.servo === 2 ? { ...servo, max: 500 } : servo)),
      }),
    );
    teaching.begin();
    await draw(TWO_READS_MS);
    board.turn(2, 700);
    await draw(TWO_READS_MS);
    teaching.end();
    await draw(4000);
    expect(ofKind('move').flatMap(({ targets }) => targets.map(({ servo }) => servo))).toEqual([
      1, 3, 4, 5, 6,
    ]);
    expect(noticeTexts().some((text) => text.includes(servoLabel(robot.servos[1]!)))).toBe(true);
  });

  test('a slider ends it, and moves its servo alone', async () => {
    const { teaching, draw, device, kinds, board, isOn, noticeTexts } = await createXarm();
    teaching.begin();
    await draw(TWO_READS_MS);
    device.move([{ servo: 4, position: 500 }], 'hand');
    await draw(TWO_READS_MS);
    expect([isOn(), noticeTexts()]).toEqual([false, [words.teach.staysReleased]]);
    const requested = kinds().filter((kind) => kind === 'readPositions').length;
    await draw(3000);
    expect(kinds().filter((kind) => kind === 'readPositions')).toHaveLength(requested);
    expect(board.snapshot().targets).toEqual([400, 400, 400, 500, 400, 400]);
  });

  const ENDINGS: readonly (readonly [string, (page: Awaited<ReturnType<typeof createXarm>>) => unknown])[] = [
    ['Stop', ({ device }) => device.halt()],
    ['a lost link', ({ channel }) => channel.unplug()],
    ['a group of the board', ({ device }) => device.run(8, 1)],
  ];
  test.each(ENDINGS)('%s ends it without a move of ours, and a notice says so', async (_, happen) => {
    const page = await createXarm();
    const { teaching, draw, isOn, ofKind, noticeTexts, reads } = page;
    teaching.begin();
    await draw(TWO_READS_MS);
    happen(page);
    await draw(200);
    expect([isOn(), ofKind('move')]).toEqual([false, []]);
    expect(noticeTexts()).toContain(words.teach.staysReleased);
    const before = reads();
    await draw(2000);
    expect(reads()).toBe(before);
  });

  test('does not begin while stopped or while something runs', async () => {
    const { teaching, draw, device, isOn, kinds } = await createXarm();
    device.halt();
    await draw(300);
    teaching.begin();
    expect(isOn()).toBe(false);
    expect(kinds()).not.toContain('release');
  });
});
