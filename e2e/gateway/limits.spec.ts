// One robot, two screens of two people: it is described once, its limits hold for both, and only the screen that calibrates a
// servo may pass them.

import type { Browser } from '@playwright/test';
import { lastTarget } from '../fixtures/bus.ts';
import { anotherBrowser, dashboardOf, READY, type Dashboard } from '../fixtures/dashboard.ts';
import { robotDialogOf } from '../fixtures/robotDialog.ts';
import type { Robot } from '../fixtures/robot.ts';
import { expect, poll, test } from '../fixtures/test.ts';

/** Of another person: nothing of the first one's browser is in it. */
async function otherScreen(browser: Browser, robot: Robot): Promise<Dashboard> {
  const page = await (await anotherBrowser(browser)).newPage();
  const dashboard = dashboardOf(page);
  await robot.open(page);
  await expect(dashboard.link).toHaveText(READY);
  return dashboard;
}

test('limits set on one screen hold on the other, while it calibrates too @exhaustive', async ({
  dashboard,
  robot,
  browser,
}) => {
  const other = await otherScreen(browser, robot);
  const robots = robotDialogOf(dashboard);
  await robots.opener.click();
  await robots.button('Edit').click();
  await robots.cell('Lowest', 'Elbow').fill('1000');
  await robots.cell('Lowest', 'Elbow').press('Enter');

  await expect(other.slider(4)).toHaveAttribute('min', '1000');
  await other.type(other.target(4), 900);
  await expect(other.notices).toContainText('Elbow: 900 is out of range; it takes 1000 to 2500.');
  await other.type(other.target(4), 1010);
  await poll(() => lastTarget(robot.bus, 4)).toBe(1010);
  await other.turn.getByRole('button', { name: 'Release control' }).click();

  await robots.button('All robots').click();
  await robots.button('Calibrate').click();
  await robots.button(/^Elbow, /).click();
  // What the other screen did is known here, so nothing has to find out where the servo stands.
  await expect(robots.now).toContainText('1010');
  await robots.jogUntil('lower', () =>
    poll(async () => (await lastTarget(robot.bus, 4)) ?? 9999).toBeLessThan(980),
  );
  await other.turn.getByRole('button', { name: 'Take over' }).click();
  // What is typed before is not sent, and not judged.
  await expect(other.turn.getByRole('button', { name: 'Release control' })).toBeVisible();
  // Nowhere on the way that it crept, in steps of 20: what a servo is at already is not judged.
  await other.type(other.target(4), 915);
  await expect(other.notices).toContainText('Elbow: 915 is out of range');
  await other.page.context().close();
});
