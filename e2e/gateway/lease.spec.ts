// One robot, several people: one drives, the others look on, ask, take over and stop. The bus tells what the robot was reported.

import type { BrowserContext, WebSocketRoute } from '@playwright/test';
import { kindsAfter, lastTarget, ofKind } from '../fixtures/bus.ts';
import { ready, type Dashboard } from '../fixtures/dashboard.ts';
import { fingersOf } from '../fixtures/fingers.ts';
import type { Robot } from '../fixtures/robot.ts';
import { robotDialogOf } from '../fixtures/robotDialog.ts';
import { expect, poll, test } from '../fixtures/test.ts';

const act = ({ turn }: Dashboard, verb: string): Promise<void> =>
  turn.getByRole('button', { name: verb, exact: true }).click();

/** So long that it is under way still when the test has looked. */
async function movesSlowly(who: Dashboard, servo: number, position: number): Promise<void> {
  await who.page.getByRole('radio', { name: 'Fixed time' }).check();
  await who.type(who.field('Move time in milliseconds'), 20_000);
  await who.type(who.target(servo), position);
}

async function joins(robot: Robot, context: BrowserContext): Promise<Dashboard> {
  const page = await context.newPage();
  await robot.open(page);
  return ready(page);
}

test('a person who is alone drives without being asked, and never hears of it @exhaustive', async ({
  dashboard,
  robot,
}) => {
  await dashboard.type(dashboard.target(1), 1800);
  await poll(() => lastTarget(robot.bus, 1)).toBe(1800);
  await expect(dashboard.turn).toHaveCount(0);
});

/** How far down the work begins, on a phone and on a desktop. */
async function topOfWork({ page }: Dashboard): Promise<readonly (number | undefined)[]> {
  const tops = [];
  for (const { isPhone, ...viewport } of [
    { width: 390, height: 844, isPhone: true },
    { width: 1440, height: 900, isPhone: false },
  ]) {
    await page.setViewportSize(viewport);
    await expect(page.getByRole('tablist')).toBeVisible({ visible: isPhone });
    tops.push((await page.getByRole('main').boundingBox())?.y);
  }
  return tops;
}

test('one drives, the other looks on, asks, is refused, asks again and is let', async ({
  dashboard,
  robot,
  context,
}) => {
  const before = await topOfWork(dashboard);
  const other = await joins(robot, context);
  await expect(dashboard.turn).toContainText('No driver');
  // Nothing moves under a finger when a person joins.
  await poll(() => topOfWork(dashboard)).toEqual(before);
  expect(before[0], 'a phone keeps its room for the work').toBeLessThanOrEqual(112);
  await dashboard.type(dashboard.target(1), 1800);
  await expect(dashboard.turn).toContainText('You drive');
  await expect(other.turn).toContainText('Another window drives');
  await expect(other.slider(1)).toHaveAttribute('aria-disabled', 'true');

  await expect(other.target(1)).toHaveValue('1800');
  await expect(other.estimate(1)).toHaveText('≈ 1800');

  await other.slider(1).click({ force: true });
  await expect(dashboard.turn).toContainText('Another window requests to drive');
  await act(dashboard, 'Refuse');
  await expect(other.turn).toContainText('Another window drives');

  await act(other, 'Request to drive');
  await act(dashboard, 'Allow');
  await expect(other.turn).toContainText('You drive');
  await expect(dashboard.slider(1)).toHaveAttribute('aria-disabled', 'true');
  await other.type(other.target(2), 1700);
  await poll(() => lastTarget(robot.bus, 2)).toBe(1700);
  await poll(() => topOfWork(dashboard)).toEqual(before);
});

test('a person who calibrates requests to drive where it is refused @exhaustive', async ({
  dashboard,
  robot,
  context,
}) => {
  const other = await joins(robot, context);
  await dashboard.type(dashboard.target(1), 1800);
  await expect(other.turn).toContainText('Another window drives');
  const robots = robotDialogOf(other);
  await robots.opener.click();
  await robots.button('Calibrate').click();
  await expect(robots.dialog).toContainText('Request to drive first.');
  await robots.button('Request to drive').click();
  await expect(robots.button('Cancel request')).toBeVisible();
  await act(dashboard, 'Allow');
  await expect(robots.button('Cancel request')).toBeHidden();
  await expect(robots.button('Go slowly to the middle').or(robots.jog('lower'))).toBeVisible();
});

test.describe('with a finger', () => {
  test.use({ hasTouch: true });

  test('scrolling past the sliders asks nothing for the robot, a tap on one does @exhaustive', async ({
    dashboard,
    robot,
    context,
  }) => {
    const other = await joins(robot, context);
    await other.page.setViewportSize({ width: 390, height: 844 });
    await dashboard.type(dashboard.target(1), 1500);
    await expect(other.turn).toContainText('Another window drives');
    const { swipe } = await fingersOf(other.page);
    await other.slider(2).scrollIntoViewIfNeeded();
    const { x, y, width } = (await other.slider(2).boundingBox())!;
    const middle = { x: x + width / 2, y: y + 10 };
    await swipe(middle, { x: middle.x, y: middle.y - 200 });
    await poll(async () => (await other.slider(2).boundingBox())!.y).toBeLessThan(y - 40);
    await expect(other.turn).toContainText('Another window drives');
    await expect(dashboard.turn).toContainText('You drive');

    // The scroll goes on for a while by itself.
    await expect(async () => {
      await other.slider(4).tap({ force: true });
      await expect(dashboard.turn).toContainText('Another window requests to drive', { timeout: 500 });
    }).toPass();
  });
});

test('a driver who says nothing passes it on; taking over asks nothing and stops what moves @exhaustive', async ({
  dashboard,
  robot,
  context,
}) => {
  const other = await joins(robot, context);
  await dashboard.type(dashboard.target(1), 1800);
  await expect(other.turn).toContainText('drives');
  await act(other, 'Request to drive');
  await expect(other.turn).toContainText('You drive', { timeout: 10_000 });

  await movesSlowly(other, 1, 900);
  await poll(() => lastTarget(robot.bus, 1)).toBe(900);
  await act(dashboard, 'Take over');
  await expect(dashboard.turn).toContainText('You drive');
  await poll(async () => ofKind(await robot.bus(), 'stop').length).toBeGreaterThanOrEqual(3);
  await expect(dashboard.status).not.toContainText('Stop');
});

test('when the driver’s window closes in a move the robot is stopped, and the other may go on', async ({
  dashboard,
  robot,
  context,
}) => {
  const driver = await joins(robot, context);
  await movesSlowly(driver, 1, 1800);
  await poll(() => lastTarget(robot.bus, 1)).toBe(1800);
  const before = (await robot.bus()).length;
  await driver.page.close();
  // More follow where the board does not confirm them.
  await poll(async () => ofKind((await robot.bus()).slice(before), 'stop').length).toBeGreaterThanOrEqual(3);
  await expect(dashboard.status).toContainText('The driver disconnected while the robot moved');
  await dashboard.resume.click();
  await dashboard.type(dashboard.target(2), 1700);
  await poll(() => lastTarget(robot.bus, 2)).toBe(1700);
});

test('a window that looks on ends nothing when its own connection breaks and is back @exhaustive', async ({
  dashboard,
  robot,
  context,
}) => {
  const page = await context.newPage();
  const sockets: WebSocketRoute[] = [];
  await page.routeWebSocket(/\/ws/, (socket) => {
    sockets.push(socket);
    socket.connectToServer();
  });
  await robot.open(page);
  const other = await ready(page);
  await movesSlowly(dashboard, 1, 1800);
  await poll(() => lastTarget(robot.bus, 1)).toBe(1800);
  const before = (await robot.bus()).length;
  await sockets[0]!.close();
  await poll(() => Promise.resolve(sockets.length)).toBe(2);
  await expect(other.turn).toContainText('Another window drives');
  await expect(other.status).not.toContainText('Stop');
  await dashboard.type(dashboard.target(2), 1700);
  await poll(() => lastTarget(robot.bus, 2)).toBe(1700);
  expect(await kindsAfter(robot.bus, before)).toEqual(['move']);
});
