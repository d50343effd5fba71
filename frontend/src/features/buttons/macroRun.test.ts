import { describe, expect, test } from 'vitest';
import { addMacro } from '#shared/profile/macroEdits.ts';
import { macroOf, type Macro, type MacroStep } from '#shared/profile/macro.ts';
import { addPose } from '#shared/profile/pose.ts';
import { createTestPage } from '../pageUnderTest.ts';

const GO = (pose: number, durationMs = 1500): MacroStep => ({ kind: 'pose', pose, durationMs });
const WAIT: MacroStep = { kind: 'wait', waitMs: 1000 };
const RUN: MacroStep = { kind: 'slot', slot: 5, times: 1 };

async function pageWith(...steps: readonly MacroStep[]) {
  const fixture = await createTestPage();
  const at = (position: number) => ({ unit: 'us' as const, targets: [{ servo: 1, position }] });
  fixture.poses.book.edit(
    () => 'capture',
    (book) => addPose(book, { name: 'Wave', ...at(1800) }),
  );
  fixture.poses.book.edit(
    () => 'capture',
    (book) => addPose(book, { name: 'Bow', ...at(1200) }),
  );
  fixture.macros.edit(
    () => 'add',
    (page) => addMacro(page, 'Greet', steps),
  );
  const greet: Macro = macroOf(fixture.macros.store.getState().present, 1)!;
  const positions = () => fixture.moves().map(({ targets }) => targets[0]?.position);
  const step = () => fixture.macroRun.store.getState()?.stepIndex ?? null;
  return { ...fixture, greet, positions, step };
}

describe('a button', () => {
  test('does its steps one after another and then is done', async () => {
    const { macroRun, greet, positions, step, clock, book } = await pageWith(GO(1), WAIT, GO(2, 500));
    macroRun.start(greet);
    await clock.advance(1400);
    expect([positions(), step()]).toEqual([[1800], 0]);
    await clock.advance(1000);
    expect([positions(), step()]).toEqual([[1800], 1]);
    await clock.advance(400);
    expect([positions(), step()]).toEqual([[1800, 1200], 2]);
    await clock.advance(600);
    expect(step()).toBeNull();
    expect(book().applied).toBe(2);
  });

  test('waits for a first move, which is slow whatever was asked for', async () => {
    const { macroRun, greet, positions, clock } = await pageWith(GO(1, 100), GO(2, 100));
    macroRun.start(greet);
    await clock.advance(1400);
    expect(positions()).toEqual([1800]);
    await clock.advance(200);
    expect(positions()).toEqual([1800, 1200]);
  });

  test('waits until the last of several first moves has ended: they begin one after another', async () => {
    const { macroRun, greet, step, clock, moves } = await pageWith(
      { kind: 'pose', pose: 'home', durationMs: 100 },
      GO(1),
    );
    macroRun.start(greet);
    await clock.advance(2700);
    expect([step(), moves().length]).toEqual([0, 6]);
    await clock.advance(100);
    expect([step(), moves().length]).toEqual([1, 7]);
  });

  test('goes on behind a slot once the board says that the group has ended', async () => {
    const { macroRun, greet, positions, step, clock, device, ofKind } = await pageWith(RUN, GO(2));
    device.download([
      {
        slot: 5,
        frames: [
          { durationMs: 2000, targets: [{ servo: 1, position: 1600 }] },
          { durationMs: 2000, targets: [{ servo: 1, position: 1500 }] },
        ],
      },
    ]);
    await clock.advance(4000);
    macroRun.start(greet);
    await clock.advance(2000);
    expect(ofKind('run')).toEqual([{ kind: 'run', slot: 5, times: 1 }]);
    expect([positions(), step()]).toEqual([[], 0]);
    await clock.advance(4000);
    expect(positions().at(-1)).toBe(1200);
  });

  test.each([
    ['STOP', (fixture: Awaited<ReturnType<typeof pageWith>>) => fixture.device.halt()],
    ['a pulled cable', (fixture: Awaited<ReturnType<typeof pageWith>>) => fixture.channel.unplug()],
    ['another robot', (fixture: Awaited<ReturnType<typeof pageWith>>) => fixture.robots.duplicate()],
    ['its second press', (fixture: Awaited<ReturnType<typeof pageWith>>) => fixture.macroRun.end()],
  ])('is ended for good by %s, also after Resume', async (_, end) => {
    const fixture = await pageWith(WAIT, { kind: 'pose', pose: 'home', durationMs: 500 });
    fixture.macroRun.start(fixture.greet);
    await fixture.clock.advance(500);
    end(fixture);
    await fixture.clock.advance(300);
    expect(fixture.step()).toBeNull();
    fixture.device.resume();
    await fixture.clock.advance(5000);
    expect(fixture.positions()).toEqual([]);
  });

  test('ended during a slot, the group on the board is ended too', async () => {
    const { macroRun, greet, clock, device, ofKind } = await pageWith(RUN, GO(2));
    device.download([
      {
        slot: 5,
        frames: [
          { durationMs: 5000, targets: [{ servo: 1, position: 1600 }] },
          { durationMs: 5000, targets: [{ servo: 1, position: 1500 }] },
        ],
      },
    ]);
    await clock.advance(4000);
    macroRun.start(greet);
    await clock.advance(500);
    macroRun.end();
    await clock.advance(12_000);
    expect(ofKind('stop').length).toBeGreaterThan(0);
    expect(ofKind('move')).toEqual([]);
  });

  test('goes no further where the run of its slot is refused', async () => {
    const { macroRun, greet, step, clock, robots, ofKind } = await pageWith(RUN, GO(2));
    const thresholds = { warnMv: 13_000, alarmMv: 12_900 };
    robots.edit(
      () => 'refuse',
      (robot) => ({ ...robot, batteryCare: { policy: 'refuse', thresholds } }),
    );
    macroRun.start(greet);
    await clock.advance(5000);
    expect(step()).toBeNull();
    expect([ofKind('run'), ofKind('move')]).toEqual([[], []]);
  });

  test('never begins while stopped, while another is at work, or without steps', async () => {
    const { macroRun, greet, step, clock, device, noticeTexts, positions } = await pageWith(GO(1, 3000));
    macroRun.start({ ...greet, steps: [] });
    device.halt();
    await clock.advance(500);
    macroRun.start(greet);
    expect(step()).toBeNull();
    expect(noticeTexts()).toEqual(['This button has no steps yet.', 'Stopped. Resume to move.']);
    device.resume();
    await clock.advance(500);
    macroRun.start(greet);
    macroRun.start({ ...greet, id: 9, steps: [GO(2)] });
    await clock.advance(5000);
    expect(positions()).toEqual([1800]);
  });

  test('with a step that cannot be, begins none of its steps', async () => {
    const fixture = await pageWith(GO(1), GO(2));
    fixture.robots.edit(
      () => 'limits',
      (robot) => ({
        ...robot,
        servos: robot.servos.map((servo) => (servo.servo === 1 ? { ...servo, min: 1300 } : servo)),
      }),
    );
    fixture.macroRun.start(fixture.greet);
    fixture.macroRun.start({ ...fixture.greet, steps: [GO(1), GO(7)] });
    await fixture.clock.advance(5000);
    expect(fixture.positions()).toEqual([]);
    expect(fixture.noticeTexts()[0]).toContain('Gripper: 1200 is out of range');
    expect(fixture.noticeTexts()[1]).toContain('This pose was deleted');
  });
});
