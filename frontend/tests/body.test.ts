// The servos on the body: picked on the picture, moved below it, arranged as their owner sees them. And with a finger, which
// scrolls more often than it moves a servo.

import type { Page } from './harness/page.ts';
import { readyRobot } from '#shared/profile/readyRobots.ts';
import { robotToText } from '#shared/profile/robotText.ts';
import { lastTarget, ofKind } from '../../e2e/fixtures/bus.ts';
import { expect, poll, test } from './harness/test.ts';

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

test('a servo picked on the body is moved by the one slider below', async ({ dashboard, robot, page }) => {
  await page.getByRole('radio', { name: 'Body' }).check();
  await expect(dashboard.slider(4)).toBeHidden();
  await dashboard.servoName(4).click();
  await dashboard.slider(4).press('Shift+ArrowRight');
  await poll(() => lastTarget(robot.bus, 4)).toBe(1510);
  await page
    .getByRole('list', { name: 'Servos on the body' })
    .getByRole('button')
    .nth(4)
    .click({
      modifiers: ['Shift'],
    });
  await dashboard.type(dashboard.target(5), 1600);
  await poll(() => lastTarget(robot.bus, 4)).toBe(1610);
});

test.describe('of a humanoid', () => {
  test.beforeEach(({ page }) => rememberHumanoid(page));

  test('a servo is dragged and pushed to another place, and stays there', async ({ dashboard, page }) => {
    await page.getByRole('radio', { name: 'Body' }).check();
    await page.getByRole('switch', { name: 'Arrange' }).check();
    const knee = dashboard.button(/^Servo 3, knee, at/);
    await expect(knee).toHaveAccessibleName('Servo 3, knee, at 64 % across, 68 % down');
    await knee.hover();
    await page.mouse.down();
    const box = await page.getByRole('list', { name: 'Servos on the body' }).locator('..').boundingBox();
    await page.mouse.move(box.x + box.width * 0.9, box.y + box.height * 0.5, { steps: 5 });
    await page.mouse.up();
    await knee.press('Shift+ArrowLeft');
    await expect(knee).toHaveAccessibleName('Servo 3, knee, at 85 % across, 50 % down');
    await page.reload();
    await page.getByRole('switch', { name: 'Arrange' }).check();
    await expect(knee).toHaveAccessibleName('Servo 3, knee, at 85 % across, 50 % down');
  });

  test('what was arranged is taken back by key and by press, and nothing else is', async ({
    dashboard,
    page,
  }) => {
    await dashboard.slider(3).press('ArrowRight');
    await dashboard.capture.click();
    await page.getByRole('radio', { name: 'Body' }).check();
    await page.getByRole('switch', { name: 'Arrange' }).check();
    const knee = dashboard.button(/^Servo 3, knee, at/);
    await knee.press('ArrowLeft');
    await knee.press('ArrowUp');
    await expect(knee).toHaveAccessibleName('Servo 3, knee, at 63 % across, 67 % down');
    await knee.press('ControlOrMeta+z');
    await expect(knee).toHaveAccessibleName('Servo 3, knee, at 63 % across, 68 % down');
    await dashboard.button('Undo: place of servo 3').click();
    await expect(knee).toHaveAccessibleName('Servo 3, knee, at 64 % across, 68 % down');
    await expect(dashboard.frames).toHaveCount(1);
  });

  test('a servo taken at its edge does not jump, and Esc puts it back where it was', async ({
    dashboard,
    page,
  }) => {
    await page.getByRole('radio', { name: 'Body' }).check();
    await page.getByRole('switch', { name: 'Arrange' }).check();
    const knee = dashboard.button(/^Servo 3, knee, at/);
    const { x, y, width, height } = await knee.boundingBox();
    const grip = { x: x + width * 0.8, y: y + height / 2 };
    await page.mouse.move(grip.x, grip.y);
    await page.mouse.down();
    await page.mouse.move(grip.x, grip.y + 40);
    await poll(async () => Math.round((await knee.boundingBox()).x - x)).toBe(0);
    await page.keyboard.press('Escape');
    await page.mouse.move(grip.x, grip.y + 80);
    await page.mouse.up();
    await expect(knee).toHaveAccessibleName('Servo 3, knee, at 64 % across, 68 % down');
  });

  test('a limb is folded away and selected as a whole', async ({ dashboard, page }) => {
    await dashboard.button('Select leftLeg').click();
    const servos = page.getByRole('region', { name: 'Servos' });
    await expect(servos.getByRole('button', { pressed: true })).toHaveCount(5);
    await dashboard.button('leftLeg, 5 servos').click();
    await expect(dashboard.slider(3)).toBeHidden();
    await expect(dashboard.slider(9)).toBeVisible();
  });
});

test.describe('of an arm on a phone', () => {
  test.override({ viewport: { width: 390, height: 844 } });

  test('base and hand are whole within the window', async ({ page, url }) => {
    await page.goto(url);
    for (const name of ['Base, from above', 'Hand, from the front']) {
      const { x, width } = await page.getByText(name).boundingBox();
      expect(x + width, name).toBeLessThanOrEqual(390);
    }
  });
});

test.describe('of a humanoid on a phone', () => {
  test.override({ screen: { hasTouch: true }, viewport: { width: 390, height: 844 } });
  test.beforeEach(({ page }) => rememberHumanoid(page));

  test('a pose with wide arms is whole within the picture, in the list and on the body', async ({
    dashboard,
    page,
  }) => {
    const picture = page.getByRole('img', { name: /Walker/ });
    const overhang = () =>
      picture.evaluate((drawn) => {
        const room = drawn.getBoundingClientRect();
        const boxes = [...drawn.querySelectorAll('path')].map((bone) => bone.getBoundingClientRect());
        const [left, right] = [
          Math.min(...boxes.map((box) => box.left)),
          Math.max(...boxes.map((box) => box.right)),
        ];
        const seen = { left: Math.max(0, room.left), right: Math.min(innerWidth, room.right) };
        return Math.max(0, Math.round(seen.left - left), Math.round(right - seen.right));
      });
    for (const arm of [8, 16]) {
      await dashboard.type(dashboard.target(arm), arm === 8 ? 500 : 2500);
      await expect(dashboard.estimate(arm)).toHaveText(arm === 8 ? '≈ 500' : '≈ 2500', { timeout: 15_000 });
    }
    expect(await overhang()).toBe(0);
    await page.getByRole('radio', { name: 'Body' }).check();
    expect(await overhang()).toBe(0);
  });

  test('servos below each other fill the screen, which scrolls as one', async ({ dashboard }) => {
    await dashboard.slider(12).scrollIntoViewIfNeeded();
    await dashboard.slider(9).scrollIntoViewIfNeeded();
    for (const servo of [9, 10, 11]) await expect(dashboard.slider(servo)).toBeInViewport();
  });
});

test.describe('with a finger', () => {
  test.override({ screen: { hasTouch: true }, viewport: { width: 390, height: 844 } });

  test('a touch beside the thumb and a swipe over a slider move nothing', async ({
    dashboard,
    robot,
    page: { touchscreen },
  }) => {
    const slider = dashboard.slider(2);
    await slider.scrollIntoViewIfNeeded();
    const box = await slider.boundingBox();
    await touchscreen.tap(box.x + box.width * 0.9, box.y + box.height / 2);
    await expect(slider).toHaveValue('1500');

    const swipe = async (byX: number, byY: number): Promise<void> => {
      const { x, y, width, height } = await slider.boundingBox();
      const from = { x: x + width / 2, y: y + height / 2 };
      await touchscreen.swipe(from, { x: from.x + byX, y: from.y + byY });
    };
    await swipe(4, -120);
    expect((await slider.boundingBox()).y).toBeLessThan(box.y - 40);
    await expect(slider).toHaveValue('1500');
    expect(ofKind(await robot.bus(), 'move')).toEqual([]);
    await swipe(80, 2);
    await poll(() => lastTarget(robot.bus, 2)).toBeGreaterThan(1600);
  });
});
