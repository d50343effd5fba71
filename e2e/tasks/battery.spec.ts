// The battery: what the board says, how old that is, and when it is low.

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
  const asked = ofKind(await robot.bus(), 'readBattery').length;
  await dashboard.battery.getByRole('button', { name: 'Refresh' }).click();
  await poll(async () => ofKind(await robot.bus(), 'readBattery').length).toBeGreaterThan(asked);
});

for (const { batteryMv, volts, word } of [
  { batteryMv: 6900, volts: '6.90 V', word: 'Low' },
  { batteryMv: 6400, volts: '6.40 V', word: 'Charge now' },
]) {
  test.describe(`at ${volts}`, () => {
    test.use({ boardSettings: { batteryMv } });
    test(`the battery is shown as “${word}”`, async ({ dashboard }) => {
      await expect(dashboard.battery).toContainText(volts);
      await expect(dashboard.battery).toContainText(word);
      await expect(dashboard.bar).toContainText(volts);
    });
  });
}
