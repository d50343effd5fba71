import { describe, expect, test } from 'vitest';
import { createTestPage } from '../pageUnderTest.ts';
import { INITIAL_SERVO_VIEW } from '../servoView.ts';

const at = (position: number) => [{ servo: 1, position }];

describe('a blend of two poses', () => {
  test('is only looked at until the robot is to follow; then gently at first, and along with the slider', async () => {
    const { blend, draw, moves, channel } = await createTestPage();
    blend.show(at(1200));
    await draw(500);
    expect(moves()).toEqual([]);
    blend.follow(true);
    await draw(1700);
    expect(moves()).toMatchObject([{ durationMs: 1500, targets: at(1200) }]);
    blend.show(at(1300));
    await draw(700);
    expect(channel.board.target(1)).toBe(1300);
  });

  test('follows between two ticks of the clock, too, while it is still on its gentle way', async () => {
    const { blend, clock, draw, moves, noticeTexts } = await createTestPage();
    blend.show(at(1200));
    blend.follow(true);
    await draw(200);
    await clock.advance(0.3);
    blend.show(at(1300));
    await draw(200);
    expect(noticeTexts()).toEqual([]);
    expect(moves().at(-1)).toMatchObject({ targets: at(1300) });
  });

  test('leaves locked servos where they are', async () => {
    const { blend, draw, moves, view, robots } = await createTestPage();
    view.setState({ servos: { ...INITIAL_SERVO_VIEW, robotId: robots.current().id, locked: [1] } });
    blend.show([...at(1200), { servo: 2, position: 1300 }]);
    blend.follow(true);
    await draw(1700);
    expect(moves()).toMatchObject([{ targets: [{ servo: 2, position: 1300 }] }]);
  });

  test('moves nothing any more once it is put away', async () => {
    const { blend, draw, moves } = await createTestPage();
    blend.show(at(1200));
    blend.follow(true);
    await draw(1700);
    blend.show(null);
    blend.show(at(1800));
    await draw(700);
    expect(moves()).toHaveLength(1);
  });

  test('STOP ends it, and Resume does not begin it again', async () => {
    const { blend, device, draw, moves } = await createTestPage();
    blend.show(at(1200));
    blend.follow(true);
    await draw(1700);
    device.halt();
    await draw(500);
    const before = moves().length;
    device.resume();
    await draw(100);
    blend.show(at(1300));
    await draw(700);
    expect(moves()).toHaveLength(before);
    expect(blend.store.getState().isLive).toBe(false);
  });
});
