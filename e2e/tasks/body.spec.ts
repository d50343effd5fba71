// The servos on the body: picked on the picture, moved below it, arranged as their owner sees them. And with a finger, which
// scrolls more often than it moves a servo.

import type { Page } from '@playwright/test';
import { readyRobot } from '#shared/actions/robot/readyRobots.ts';
import { robotToText } from '#shared/actions/robot/robotText.ts';
import { lastTarget, ofKind } from '../fixtures/bus.ts';
import { expect, poll, test } from '../fixtures/test.ts';

const HUMANOID = readyRobot('humanoid16', 'doc', {
  robot: 'Walker',
  role: (role) => role,
  limb: (limb) => limb,
});

const rememberHumanoid = (page: Page): Promise<unknown> =>
  page.addInitScript(
    (robots) => localStorage.getItem('servodeck.robots') ?? localStorage.setItem('servodeck.robots', robots),
    JSON.stringify({ files: [{ id: 1, file: robotToText(HUMANOID) }], currentId: 1, nextId: 2 }),
  );

test.describe('of a humanoid on a phone', () => {
  test.use({ hasTouch: true, isMobile: true, viewport: { width: 390, height: 844 } });
  test.beforeEach(({ page }) => rememberHumanoid(page));

  test('servos below each other fill the screen, which scrolls as one', async ({ dashboard }) => {
    await dashboard.slider(12).scrollIntoViewIfNeeded();
    await dashboard.slider(9).scrollIntoViewIfNeeded();
    for (const servo of [9, 10, 11]) await expect(dashboard.slider(servo)).toBeInViewport();
  });
});

test.describe('with a finger', () => {
  test.use({ hasTouch: true, isMobile: true, viewport: { width: 390, height: 844 } });

  test('a touch beside the thumb and a swipe over a slider move nothing', async ({
    dashboard,
    robot,
    page,
  }) => {
    await dashboard.slider(2).scrollIntoViewIfNeeded();
    const box = (await dashboard.slider(2).boundingBox())!;
    const y = box.y + box.height / 2;
    await page.touchscreen.tap(box.x + box.width * 0.9, y);
    await expect(dashboard.slider(2)).toHaveValue('1500');

    const finger = await page.context().newCDPSession(page);
    const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', x: number, atY: number) =>
      finger.send('Input.dispatchTouchEvent', {
        type,
        touchPoints: type === 'touchEnd' ? [] : [{ x, y: atY }],
      });
    const swipe = async (alongX: number, alongY: number): Promise<void> => {
      const from = (await dashboard.slider(2).boundingBox())!;
      const [x, startY] = [from.x + from.width / 2, from.y + from.height / 2];
      await touch('touchStart', x, startY);
      for (let step = 1; step <= 8; step += 1)
        await touch('touchMove', x + (alongX * step) / 8, startY + (alongY * step) / 8);
      await touch('touchEnd', x, startY);
    };
    await swipe(4, -120);
    await expect(dashboard.slider(2)).toHaveValue('1500');
    expect(ofKind(await robot.bus(), 'move')).toEqual([]);
    await swipe(80, 2);
    await poll(() => lastTarget(robot.bus, 2)).toBeGreaterThan(1600);
  });
});
