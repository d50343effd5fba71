// The battery: what the board says, how old that is, what feeds the robot, and what happens when it is low.

import { ofKind } from '../../e2e/fixtures/bus.ts';
import { expect, poll, test } from './harness/test.ts';

test('the battery is read in volts, with the age of the reading', async ({ dashboard, robot, page }) => {
  await expect(dashboard.battery).toContainText('7.50 V');
  await expect(dashboard.battery).toContainText(/\d sec\. ago/);
  await expect(page.getByRole('meter', { name: 'Battery voltage' })).toHaveAttribute('aria-valuenow', '7.5');
  await expect(dashboard.bar).toContainText('7.50 V');
  await expect(dashboard.battery).not.toContainText('%');
  const asked = ofKind(await robot.bus(), 'readBattery').length;
  await dashboard.battery.getByRole('button', { name: 'Refresh' }).click();
  await poll(async () => ofKind(await robot.bus(), 'readBattery').length).toBeGreaterThan(asked);
});

test('of a pack it tells what is left, and how it went in words', async ({ dashboard, page }) => {
  await dashboard.feedBy('2S pack');
  await expect(dashboard.battery).toContainText('2S pack');
  await expect(dashboard.battery).toContainText('≈ 54 %', { timeout: 20_000 });
  await expect(
    page.getByRole('img', {
      name: 'Voltage in this session: lowest 7.50 V, highest 7.50 V, now 7.50 V; 0 runs',
    }),
  ).toBeVisible();
});

for (const { batteryMv, volts, word } of [
  { batteryMv: 6900, volts: '6.90 V', word: 'Low' },
  { batteryMv: 6400, volts: '6.40 V', word: 'Charge now' },
]) {
  test.describe(`at ${volts}`, () => {
    test.override({ boardSettings: { batteryMv } });
    test(`a pack is shown as “${word}”, in the tab too`, async ({ dashboard, page }) => {
      await dashboard.feedBy('2S pack');
      await expect(dashboard.battery).toContainText(volts);
      await expect(dashboard.battery).toContainText(word);
      await expect(dashboard.bar).toContainText(volts);
      await expect.poll(() => page.title()).toBe(`Low battery, ${volts} – Servodeck`);
      const icon = page.locator('link[rel="icon"]');
      await expect(icon).toHaveAttribute('href', /^data:image\/svg/);
      await dashboard.feedBy('Adapter', { warn: 6200, alarm: 6000 });
      await expect.poll(() => page.title()).toBe('Servodeck');
      await expect(icon).not.toHaveAttribute('href', /^data:/);
    });
  });
}

test.describe('at its alarm', () => {
  test.override({ boardSettings: { batteryMv: 6500 } });
  test('a pack may refuse new runs, and a person may insist once', async ({ dashboard, robot }) => {
    await dashboard.feedBy('2S pack', { policy: 'Refuse new runs' });
    await expect(dashboard.notices).toContainText('New runs are refused', { timeout: 20_000 });
    await dashboard.button('Run').click();
    await expect(dashboard.notices).toContainText(
      'Not started because of the battery alarm: 6.50 V at rest.',
    );
    expect(ofKind(await robot.bus(), 'run')).toEqual([]);
    await dashboard.button('Start anyway').click();
    await poll(async () => ofKind(await robot.bus(), 'run')).toHaveLength(1);
  });

  test('a robot that was taken to rest says that Stop was not pressed', async ({ dashboard }) => {
    await dashboard.feedBy('2S pack', { policy: 'Go to rest and stop' });
    await expect(dashboard.status).toContainText('Stopped by the robot’s low-battery setting', {
      timeout: 40_000,
    });
  });
});

for (const { batteryMv, volts, word } of [
  { batteryMv: 9900, volts: '> 9.80 V', word: 'More than it can measure' },
  { batteryMv: 0, volts: '0.00 V', word: 'The board reads 0 V' },
]) {
  test.describe(`at ${batteryMv} mV`, () => {
    test.override({ boardSettings: { batteryMv } });
    test('nothing is judged', async ({ dashboard, page }) => {
      await expect(dashboard.battery).toContainText(volts);
      await expect(dashboard.battery).toContainText(word);
      await expect.poll(() => page.title()).toBe('Servodeck');
    });
  });
}
