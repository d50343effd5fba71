// Teaching by hand over the gateway: an xArm on a serial device whose released servos the test turns. The oracle is what the
// board heard, and where its servos stand.

import type { Browser } from '@playwright/test';
import { createBoardInTest, type BoardInTest } from '../fixtures/boardInTest.ts';
import { ofKind } from '../fixtures/bus.ts';
import { anotherBrowser, ready, type Dashboard } from '../fixtures/dashboard.ts';
import { expect, poll, test as base } from '../fixtures/test.ts';

const test = base.extend<{ arm: BoardInTest; teaching: Dashboard }>({
  arm: async ({ scratch }, use) => {
    const arm = await createBoardInTest(scratch, 'xarm');
    await use(arm);
    await arm.end();
  },
  /** Its servos are released and read. */
  teaching: async ({ page, arm, newGateway }, use) => {
    const { url } = await newGateway({ serial: arm.device, board: 'xarm' });
    await page.goto(url);
    const dashboard = await ready(page);
    await dashboard.button('Teach').click();
    await page.getByRole('button', { name: 'Release and teach' }).click();
    await expect(dashboard.target(6)).toHaveValue('400');
    await use(dashboard);
  },
});

const SIX = [1, 2, 3, 4, 5, 6];

test('the arm is posed by hand, captured while it is read, and holds at the end', async ({
  teaching: dashboard,
  arm,
}) => {
  arm.turn(3, 620);
  await expect(dashboard.target(3)).toHaveValue('620');
  await expect(dashboard.estimate(3)).toHaveText('≈ 620');
  await dashboard.capture.click();
  arm.turn(3, 300);
  arm.turn(5, 710);
  await expect(dashboard.target(3)).toHaveValue('300');
  await expect(dashboard.target(5)).toHaveValue('710');
  await dashboard.capture.click();
  await expect(dashboard.frame(2)).toBeVisible();
  expect(ofKind(await arm.bus(), 'move')).toEqual([]);

  await dashboard.button('Hold and end teaching').click();
  const moves = async () =>
    ofKind(await arm.bus(), 'move').map(({ targets: [target], durationMs }) => [
      target?.servo,
      target?.position,
      durationMs,
    ]);
  const held = [400, 400, 300, 400, 710, 400];
  await poll(moves).toEqual(SIX.map((servo) => [servo, held[servo - 1], 1500]));
  await expect(dashboard.button('Teach')).toBeEnabled();
  // They hold against a hand again, and none has moved.
  for (const servo of SIX) arm.turn(servo, 900);
  expect(SIX.map(arm.pulse)).toEqual(held);
});

/** Another person on another computer who looks on. */
async function onlooker(browser: Browser, page: Dashboard['page']): Promise<Dashboard> {
  const context = await anotherBrowser(browser, { locale: 'en-GB', viewport: page.viewportSize() });
  const other = await context.newPage();
  await other.goto(page.url());
  return ready(other);
}

test('a person who takes over ends it: nothing moves, the teacher is reported, and a servo that was let go goes gently @exhaustive', async ({
  teaching: dashboard,
  arm,
  browser,
}) => {
  const other = await onlooker(browser, dashboard.page);
  await other.turn.getByRole('button', { name: 'Request to drive' }).click();
  await dashboard.turn.getByRole('button', { name: 'Allow' }).click();
  await expect(other.turn).toContainText('You drive');
  await expect(dashboard.notices).toContainText('Teaching has ended. The servos are still released');
  await expect(dashboard.page.getByText('Teaching: turn the servos by hand')).toHaveCount(0);
  arm.turn(2, 555);
  expect(arm.pulse(2)).toBe(555);
  expect(ofKind(await arm.bus(), 'move')).toEqual([]);

  // A servo that hands may have turned since goes gently wherever it is sent.
  await other.slider(2).press('ArrowRight');
  await poll(async () => ofKind(await arm.bus(), 'move')).not.toEqual([]);
  const [move] = ofKind(await arm.bus(), 'move');
  expect(move?.targets.map(({ servo }) => servo)).toEqual([2]);
  expect(move?.durationMs).toBeGreaterThanOrEqual(1500);
});
