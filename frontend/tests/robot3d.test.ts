// The robot in three dimensions: its limbs are led by their ends, and what leaves is what a slider would send.

import { lastTarget, ofKind } from '../../e2e/fixtures/bus.ts';
import type { Page } from './harness/page.ts';
import { expect, poll, test, type Dashboard } from './harness/test.ts';
import { advance } from './harness/time.ts';

const ARM_SERVOS = [3, 4, 5, 6];

function modelOf(page: Page) {
  return {
    handle: page.getByRole('button', { name: 'Move the end of Wrist' }),
    picture: page.getByRole('img', { name: /in three dimensions/ }),
    along: (axis: 'Forward' | 'Left' | 'Up') => page.getByRole('textbox', { name: axis, exact: true }),
  };
}

async function openStraight({ dashboard, page }: { dashboard: Dashboard; page: Page }) {
  await page.getByRole('radio', { name: '3D' }).check();
  const model = modelOf(page);
  await dashboard.button('Position of the gripper').click();
  await expect(model.along('Up')).toBeDisabled();
  await dashboard.button('Centre all').click();
  await advance(5000);
  await expect(model.along('Up')).toHaveValue('413');
  return model;
}

test('an arm whose servos stand somewhere unknown is not led', async ({ page, dashboard }) => {
  await page.getByRole('radio', { name: '3D' }).check();
  await expect(modelOf(page).picture).toBeVisible();
  await expect(modelOf(page).handle).toBeHidden();
  await expect(dashboard.stop).toBeEnabled();
});

test('arrow keys move the end of an arm by millimetres', async ({ dashboard, page, robot }) => {
  const model = await openStraight({ dashboard, page });
  await model.handle.press('Shift+ArrowRight');
  await expect(model.along('Forward')).toHaveValue('10');
  await expect(model.along('Up')).toHaveValue('413');
  await model.handle.press('PageUp');
  await expect(model.along('Left')).toHaveValue('1');
  const moved = ofKind(await robot.bus(), 'move').at(-1);
  expect(ARM_SERVOS).toContain(moved?.targets[0]?.servo);
});

test('a typed place is one slow move; out of reach nothing moves', async ({ dashboard, page, robot }) => {
  const model = await openStraight({ dashboard, page });
  await dashboard.type(model.along('Up'), 250);
  await expect(model.along('Up')).toHaveValue('250');
  await dashboard.type(model.along('Forward'), 150);
  await expect(model.along('Forward')).toHaveValue('150');
  const slow = ofKind(await robot.bus(), 'move').at(-1);
  expect(slow?.durationMs).toBeGreaterThanOrEqual(300);

  const moves = ofKind(await robot.bus(), 'move').length;
  await dashboard.type(model.along('Forward'), 900);
  await expect(dashboard.notices).toContainText('The arm cannot reach there');
  await expect(model.along('Forward')).toHaveValue('150');
  expect(ofKind(await robot.bus(), 'move')).toHaveLength(moves);
});

test('the elbow goes to the other side, and the gripper comes back to its place', async ({
  dashboard,
  page,
  robot,
}) => {
  const model = await openStraight({ dashboard, page });
  await dashboard.button('Other elbow').click();
  await expect(dashboard.notices).toContainText('the arm does not get there');
  await dashboard.type(model.along('Up'), 300);
  await dashboard.type(model.along('Forward'), 150);
  await advance(3000);
  const before = await lastTarget(robot.bus, 4);
  const movesBefore = ofKind(await robot.bus(), 'move').length;
  await dashboard.button('Other elbow').click();
  await advance(3000);
  await expect(model.along('Up')).toHaveValue('300');
  await expect(model.along('Forward')).toHaveValue('150');
  const after = await lastTarget(robot.bus, 4);
  expect(Math.sign((after ?? 0) - 1500)).toBe(-Math.sign((before ?? 0) - 1500));
  const parts = ofKind(await robot.bus(), 'move').slice(movesBefore);
  const takesMs = parts.reduce((sum, { durationMs }) => sum + durationMs, 0);
  expect(takesMs).toBeGreaterThanOrEqual(300);
});

test('a locked servo stays where it is while the end is led', async ({ dashboard, page, robot }) => {
  const model = await openStraight({ dashboard, page });
  await page.getByRole('radio', { name: 'List' }).check();
  await dashboard.servoName(4).click();
  await dashboard.button('Lock').click();
  await page.getByRole('radio', { name: '3D' }).check();
  await dashboard.button('Position of the gripper').click();
  await model.handle.press('Shift+ArrowRight');
  await expect(model.along('Forward')).toHaveValue('10');
  expect(await lastTarget(robot.bus, 4)).toBe(1500);
});

test('the end follows the pointer, and STOP ends it', async ({ dashboard, page, robot }) => {
  const model = await openStraight({ dashboard, page });
  await model.handle.hover();
  await page.mouse.down();
  const box = await model.handle.boundingBox();
  await page.mouse.move(box.x + 60, box.y + 60, { steps: 6 });
  await poll(async () => (await lastTarget(robot.bus, 5)) !== 1500).toBe(true);
  await dashboard.stop.press('Escape');
  await advance(1000);
  const moves = ofKind(await robot.bus(), 'move').length;
  await page.mouse.move(box.x - 60, box.y + 60, { steps: 6 });
  await page.mouse.up();
  await advance(1000);
  expect(ofKind(await robot.bus(), 'move').length).toBe(moves);
});

test('the first touch of a straight arm turns each servo a little', async ({ dashboard, page, robot }) => {
  const model = await openStraight({ dashboard, page });
  await model.handle.hover();
  await page.mouse.down();
  const box = await model.handle.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x + 6, y + 6, { steps: 3 });
  await advance(220);
  for (const servo of ARM_SERVOS) {
    const turned = Math.abs(((await lastTarget(robot.bus, servo)) ?? 1500) - 1500);
    // 11 µs are a degree.
    expect(turned, `of servo ${servo}`).toBeLessThan(15 * 11);
  }
  await page.mouse.move(x + 60, y + 60, { steps: 12 });
  await advance(1000);
  await expect(model.handle).toHaveAttribute('data-short', 'false');
  await page.mouse.up();
});

test('beside the axis of the base one key press turns no servo far, and a held key less', async ({
  dashboard,
  page,
  robot,
}) => {
  const model = await openStraight({ dashboard, page });
  const base = async (): Promise<number> => (await lastTarget(robot.bus, 6)) ?? 1500;
  await model.handle.press('ArrowRight');
  await model.handle.focus();
  const turned: number[] = [];
  // The first is a press, the others come from a key that stays down. 11 µs are a degree.
  for (let press = 0; press < 4; press++) {
    const before = await base();
    await page.keyboard.down('PageUp');
    await advance(100);
    turned.push(Math.abs((await base()) - before));
  }
  await page.keyboard.up('PageUp');
  const [first = 0, ...held] = turned;
  expect(first).toBeGreaterThan(2 * 11);
  expect(first).toBeLessThan(10 * 11);
  expect(Math.max(...held)).toBeLessThan(1.5 * 11);
});

test('a press on a part selects its servo', async ({ dashboard, page }) => {
  const model = await openStraight({ dashboard, page });
  const box = await model.picture.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height * 0.55);
  await page.mouse.down();
  await page.mouse.up();
  await expect(page.getByRole('group', { name: 'Selected servos' })).toContainText(/Servo [3-6]/);
});

test('a group that goes through the floor says when', async ({ dashboard, page }) => {
  const model = await openStraight({ dashboard, page });
  await dashboard.button('Capture frame').click();
  await dashboard.type(model.along('Up'), 250);
  await dashboard.type(model.along('Forward'), 150);
  await dashboard.button('Capture frame').click();
  const warning = page.getByText(/below the floor/);
  await expect(warning).toBeHidden();
  await dashboard.type(model.along('Up'), -20);
  await expect(model.along('Up')).toHaveValue('-20');
  await dashboard.button('Capture frame').click();
  await expect(warning).toBeVisible();
});

test('the frames before and after the playhead are outlined on request', async ({ dashboard, page }) => {
  const model = await openStraight({ dashboard, page });
  for (const up of [300, 250, 200]) {
    await dashboard.type(model.along('Up'), up);
    await dashboard.button('Capture frame').click();
  }
  await advance(5000);
  const toggle = dashboard.button('Frames before and after');
  const press = async (): Promise<void> => {
    await toggle.press('Enter');
    await advance(400);
  };
  // The picture alone: a button that is pressed looks otherwise.
  await page
    .getByRole('group', { name: 'View', exact: true })
    .evaluate((buttons) => (buttons.style.opacity = '0'));
  const before = await model.picture.screenshot();
  const isAsBefore = async (): Promise<boolean> => (await model.picture.screenshot()).equals(before);
  await press();
  await expect(toggle).toHaveAttribute('aria-pressed', 'true');
  expect(await isAsBefore()).toBe(false);
  await press();
  expect(await isAsBefore()).toBe(true);
});
