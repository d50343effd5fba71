// One robot, two screens: whoever looks on can stop it, and both see that it is stopped.

import { ofKind } from '../fixtures/bus.ts';
import { dashboardOf, READY } from '../fixtures/dashboard.ts';
import { expect, poll, test } from '../fixtures/test.ts';

test('a STOP on one screen stops the robot for both, and either may resume', async ({
  dashboard,
  robot,
  context,
}) => {
  await dashboard.type(dashboard.target(1), 2000);
  const other = dashboardOf(await context.newPage());
  await robot.open(other.page);
  await expect(other.link).toHaveText(READY);
  await expect(other.target(1), 'whoever comes late learns of moves before').toHaveValue('2000');
  await expect(other.estimate(1)).toHaveText('≈ 2000');
  await dashboard.type(dashboard.target(1), 1800);
  await other.stop.click();
  await expect(dashboard.status).toContainText('Stopped in another window');
  await expect(dashboard.slider(1)).toHaveAttribute('aria-disabled', 'true');
  await poll(async () => ofKind(await robot.bus(), 'stop').length).toBeGreaterThanOrEqual(3);
  await dashboard.resume.click();
  await expect(other.status).toHaveText('Idle');
  await expect(dashboard.status).toHaveText('Idle');
  await expect(other.notices).toContainText('Another window chose Resume');
});
