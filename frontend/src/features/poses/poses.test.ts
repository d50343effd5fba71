import { describe, expect, test } from 'vitest';
import { EMPTY_BOOK, addPose, markRest, poseBookToText } from '#shared/profile/pose.ts';
import { undoLabel } from '#shared/document/history.ts';
import { createDesk } from '../deskUnderTest.ts';
import { words } from '../../i18n/words.ts';
import { INITIAL_SERVO_VIEW } from '../drive/servoView.ts';

const at = (position: number) => ({ unit: 'us' as const, targets: [{ servo: 1, position }] });

async function deskWithPoses() {
  const desk = await createDesk();
  desk.poses.book.edit(
    () => 'capture',
    (book) => addPose(book, { name: 'Wave', ...at(1800) }),
  );
  desk.poses.book.edit(
    () => 'capture',
    (book) => addPose(book, { name: 'Bow', ...at(1200) }),
  );
  return desk;
}

const lastMove = ({ moves }: Awaited<ReturnType<typeof deskWithPoses>>) => moves().at(-1);

describe('going to a pose', () => {
  test('moves the robot in the given time and is noted as one step', async () => {
    const desk = await deskWithPoses();
    expect(desk.poses.apply(1, 2500)).toBe(true);
    await desk.clock.advance(200);
    expect(lastMove(desk)).toMatchObject({ durationMs: 2500, targets: [{ servo: 1, position: 1800 }] });
    expect(desk.book().applied).toBe(1);
    expect(undoLabel(desk.poses.book.store.getState())).toBe('go to Wave');
  });

  test('undo and redo change what is noted and send nothing', async () => {
    const desk = await deskWithPoses();
    desk.poses.apply(1, 1500);
    await desk.clock.advance(3000);
    desk.poses.apply(2, 1500);
    await desk.clock.advance(3000);
    const heard = desk.heard.length;
    desk.poses.book.undo();
    expect(desk.book().applied).toBe(1);
    desk.poses.book.redo();
    expect(desk.book().applied).toBe(2);
    await desk.clock.advance(3000);
    expect(desk.heard).toHaveLength(heard);
  });

  test('home is every servo at its home; rest is the marked pose, else home', async () => {
    const desk = await deskWithPoses();
    const home = [1, 2, 3, 4, 5, 6].map((servo) => ({ servo, position: 1500 }));
    expect(desk.poses.targetsOf('home')).toEqual(home);
    expect(desk.poses.targetsOf('rest')).toEqual(home);
    desk.poses.book.edit(
      () => 'rest',
      (book) => markRest(book, 2),
    );
    desk.poses.apply('rest', 1500);
    await desk.clock.advance(200);
    expect(lastMove(desk)?.targets).toEqual([{ servo: 1, position: 1200 }]);
    expect(desk.book().applied).toBe('rest');
  });

  test('locked servos stay where they are, and the person is told', async () => {
    const desk = await deskWithPoses();
    const lock = (...locked: readonly number[]): void =>
      desk.view.setState({
        servos: { ...INITIAL_SERVO_VIEW, robotId: desk.robots.current().id, locked },
      });
    lock(1, 3);
    expect(desk.poses.apply('home', 1500)).toBe(true);
    await desk.clock.advance(3000);
    expect(desk.moves().flatMap(({ targets }) => targets.map(({ servo }) => servo))).toEqual([2, 4, 5, 6]);
    expect(desk.told()).toEqual(['Gripper and Wrist are locked and stay.']);
    expect(desk.poses.apply(1, 1500)).toBe(false);
    expect(desk.told()).toContain('Gripper is locked and stays.');
    expect(desk.book().applied).toBe('home');
    lock();
    expect(desk.poses.apply(1, 1500)).toBe(true);
  });

  test('a limit, a latch or a missing pose refuses it, and nothing is noted', async () => {
    const desk = await deskWithPoses();
    desk.robots.edit(
      () => 'limits',
      (robot) => ({
        ...robot,
        servos: robot.servos.map((servo) => (servo.servo === 1 ? { ...servo, max: 1700 } : servo)),
      }),
    );
    expect(desk.poses.apply(1, 1500)).toBe(false);
    expect(desk.told()[0]).toContain('Gripper: 1800 is out of range');
    expect(desk.poses.apply(9, 1500)).toBe(false);
    desk.device.halt();
    await desk.clock.advance(500);
    expect(desk.poses.apply(2, 1500)).toBe(false);
    expect(desk.book().applied).toBeNull();
    expect(desk.moves()).toEqual([]);
  });

  test('a pose of a board that counts otherwise is refused', async () => {
    const desk = await createDesk();
    desk.poses.book.edit(
      () => 'capture',
      (book) => addPose(book, { name: 'Bus', ...at(500), unit: 'steps' }),
    );
    expect(desk.poses.apply(1, 1500)).toBe(false);
    expect(desk.moves()).toEqual([]);
  });
});

describe('the book', () => {
  test('belongs to its robot, with its own undo, and is there at the next visit', async () => {
    const desk = await deskWithPoses();
    desk.robots.duplicate();
    expect(desk.book().poses).toEqual([]);
    desk.poses.book.undo();
    expect(desk.book().poses).toEqual([]);
    desk.robots.takeUp(1);
    expect(desk.book().poses).toHaveLength(2);
    desk.poses.book.undo();
    expect(desk.book().poses).toHaveLength(1);
    const again = await createDesk(desk.texts);
    expect(again.book()).toEqual(desk.book());
  });

  test('text that is none of ours is set aside', async () => {
    const desk = await createDesk(new Map([['servodeck.poses.1', '{"poses":1}']]));
    expect(desk.book().poses).toEqual([]);
    expect(desk.texts.get('servodeck.poses.1.unreadable')).toBe('{"poses":1}');
    expect(desk.told()).toHaveLength(1);
  });

  test('takes the poses of a file, all or none', async () => {
    const desk = await deskWithPoses();
    const file = poseBookToText(desk.book());
    desk.poses.importText(file);
    expect(desk.book().poses.map(({ name }) => name)).toEqual(['Wave', 'Bow', 'Wave', 'Bow']);
    desk.poses.importText(file.replace('1200', '2600'));
    desk.poses.importText('nonsense');
    expect(desk.book().poses).toHaveLength(4);
    expect(desk.told()).toEqual([
      expect.stringContaining('Gripper: 2600 is out of range'),
      words.poses.importFailed({ flaw: words.flaws.notOurs }),
    ]);
  });

  test('says which servos of a file are not on the robot', async () => {
    const desk = await deskWithPoses();
    const targets = [31, 1, 9].map((servo) => ({ servo, position: 1500 }));
    desk.poses.importText(poseBookToText(addPose(EMPTY_BOOK, { name: 'Odd', unit: 'us', targets })));
    expect(desk.book().poses.at(-1)?.name).toBe('Odd');
    expect(desk.told()).toEqual([words.poses.strangers({ servos: words.numbers.formatList([9, 31]) })]);
  });
});
