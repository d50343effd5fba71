import { describe, expect, test } from 'vitest';
import { EMPTY_BOOK, addPose, markRest, poseBookToText } from '#shared/profile/pose.ts';
import { undoLabel } from '#shared/document/history.ts';
import { createTestPage } from '../pageUnderTest.ts';
import { words } from '../../i18n/words.ts';
import { INITIAL_SERVO_VIEW } from '../servoView.ts';

const at = (position: number) => ({ unit: 'us' as const, targets: [{ servo: 1, position }] });

async function pageWithPoses() {
  const page = await createTestPage();
  page.poses.book.edit(
    () => 'capture',
    (book) => addPose(book, { name: 'Wave', ...at(1800) }),
  );
  page.poses.book.edit(
    () => 'capture',
    (book) => addPose(book, { name: 'Bow', ...at(1200) }),
  );
  return page;
}

const lastMove = ({ moves }: Awaited<ReturnType<typeof pageWithPoses>>) => moves().at(-1);

describe('going to a pose', () => {
  test('moves the robot in the given time and is noted as one step', async () => {
    const page = await pageWithPoses();
    expect(page.poses.apply(1, 2500)).toBe(true);
    await page.clock.advance(200);
    expect(lastMove(page)).toMatchObject({ durationMs: 2500, targets: [{ servo: 1, position: 1800 }] });
    expect(page.book().applied).toBe(1);
    expect(undoLabel(page.poses.book.store.getState())).toBe('go to Wave');
  });

  test('undo and redo change what is noted and send nothing', async () => {
    const page = await pageWithPoses();
    page.poses.apply(1, 1500);
    await page.clock.advance(3000);
    page.poses.apply(2, 1500);
    await page.clock.advance(3000);
    const heard = page.heard.length;
    page.poses.book.undo();
    expect(page.book().applied).toBe(1);
    page.poses.book.redo();
    expect(page.book().applied).toBe(2);
    await page.clock.advance(3000);
    expect(page.heard).toHaveLength(heard);
  });

  test('home is every servo at its home; rest is the marked pose, else home', async () => {
    const page = await pageWithPoses();
    const home = [1, 2, 3, 4, 5, 6].map((servo) => ({ servo, position: 1500 }));
    expect(page.poses.targetsOf('home')).toEqual(home);
    expect(page.poses.targetsOf('rest')).toEqual(home);
    page.poses.book.edit(
      () => 'rest',
      (book) => markRest(book, 2),
    );
    page.poses.apply('rest', 1500);
    await page.clock.advance(200);
    expect(lastMove(page)?.targets).toEqual([{ servo: 1, position: 1200 }]);
    expect(page.book().applied).toBe('rest');
  });

  test('locked servos stay where they are, and a notice says so', async () => {
    const page = await pageWithPoses();
    const lock = (...locked: readonly number[]): void =>
      page.view.setState({
        servos: { ...INITIAL_SERVO_VIEW, robotId: page.robots.current().id, locked },
      });
    lock(1, 3);
    expect(page.poses.apply('home', 1500)).toBe(true);
    await page.clock.advance(3000);
    expect(page.moves().flatMap(({ targets }) => targets.map(({ servo }) => servo))).toEqual([2, 4, 5, 6]);
    expect(page.noticeTexts()).toEqual(['Gripper and Wrist are locked and do not move.']);
    expect(page.poses.apply(1, 1500)).toBe(false);
    expect(page.noticeTexts()).toContain('Gripper is locked and does not move.');
    expect(page.book().applied).toBe('home');
    lock();
    expect(page.poses.apply(1, 1500)).toBe(true);
  });

  test('a limit, a latch or a missing pose refuses it, and nothing is noted', async () => {
    const page = await pageWithPoses();
    page.robots.edit(
      () => 'limits',
      (robot) => ({
        ...robot,
        servos: robot.servos.map((servo) => (servo.servo === 1 ? { ...servo, max: 1700 } : servo)),
      }),
    );
    expect(page.poses.apply(1, 1500)).toBe(false);
    expect(page.noticeTexts()[0]).toContain('Gripper: 1800 is out of range');
    expect(page.poses.apply(9, 1500)).toBe(false);
    page.device.halt();
    await page.clock.advance(500);
    expect(page.poses.apply(2, 1500)).toBe(false);
    expect(page.book().applied).toBeNull();
    expect(page.moves()).toEqual([]);
  });

  test('a pose of a board that counts otherwise is refused', async () => {
    const page = await createTestPage();
    page.poses.book.edit(
      () => 'capture',
      (book) => addPose(book, { name: 'Bus', ...at(500), unit: 'steps' }),
    );
    expect(page.poses.apply(1, 1500)).toBe(false);
    expect(page.moves()).toEqual([]);
  });
});

describe('the book', () => {
  test('belongs to its robot, with its own undo, and is there at the next visit', async () => {
    const page = await pageWithPoses();
    page.robots.duplicate();
    expect(page.book().poses).toEqual([]);
    page.poses.book.undo();
    expect(page.book().poses).toEqual([]);
    page.robots.takeUp(1);
    expect(page.book().poses).toHaveLength(2);
    page.poses.book.undo();
    expect(page.book().poses).toHaveLength(1);
    const again = await createTestPage(page.texts);
    expect(again.book()).toEqual(page.book());
  });

  test('text that is none of ours is set aside', async () => {
    const page = await createTestPage(new Map([['servodeck.poses.1', '{"poses":1}']]));
    expect(page.book().poses).toEqual([]);
    expect(page.texts.get('servodeck.poses.1.unreadable')).toBe('{"poses":1}');
    expect(page.noticeTexts()).toHaveLength(1);
  });

  test('takes the poses of a file, all or none', async () => {
    const page = await pageWithPoses();
    const file = poseBookToText(page.book());
    page.poses.importText(file);
    expect(page.book().poses.map(({ name }) => name)).toEqual(['Wave', 'Bow', 'Wave', 'Bow']);
    page.poses.importText(file.replace('1200', '2600'));
    page.poses.importText('nonsense');
    expect(page.book().poses).toHaveLength(4);
    expect(page.noticeTexts()).toEqual([
      expect.stringContaining('Gripper: 2600 is out of range'),
      words.poses.importFailed({ flaw: words.flaws.notOurs }),
    ]);
  });

  test('says which servos of a file are not on the robot', async () => {
    const page = await pageWithPoses();
    const targets = [31, 1, 9].map((servo) => ({ servo, position: 1500 }));
    page.poses.importText(poseBookToText(addPose(EMPTY_BOOK, { name: 'Odd', unit: 'us', targets })));
    expect(page.book().poses.at(-1)?.name).toBe('Odd');
    expect(page.noticeTexts()).toEqual([
      words.poses.unknownServos({ servos: words.numbers.formatList([9, 31]) }),
    ]);
  });
});
