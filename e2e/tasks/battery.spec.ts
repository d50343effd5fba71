// The battery: what the board says, how old that is, what feeds the robot, and what happens when it is low.

import { ofKind } from '../fixtures/bus.ts';
import { expect, poll, test } from '../fixtures/test.ts';

test('the battery is read in volts, with the age of the reading @everyWay', async ({
  dashboard,
  robot,
  page,
}) => {
  await expect(dashboard.battery).toContainText('7.50 V');
  await expect(dashboard.battery).toContainText(/\d sec\. ago/);
  await expect(page.getByRole('meter', { name: 'Battery voltage' })).toHaveAttribute('aria-valuenow', '7.5');
  await expect(dashboard.bar).toContainText('7.50 V');
  await expect(dashboard.battery).not.toContainText('%');
  const asked = ofKind(await robot.bus(), 'readBattery').length;
  await dashboard.battery.getByRole('button', { name: 'Refresh' }).click();
  await poll(async () => ofKind(await robot.bus(), 'readBattery').length).toBeGreaterThan(asked);
});
