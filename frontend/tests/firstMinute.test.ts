// Without a gateway and without a robot the page is alive on the simulated one, says so, and offers the ways to a real one,
// each with the reason where it is not possible.

import { vi } from 'vitest';
import { dashboardOf, expect, test } from './harness/test.ts';

test('without a gateway the page starts on the simulated robot, and it moves', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await expect(dashboard.link).toHaveText(/Ready\s*Simulated/);
  await expect(dashboard.battery).toContainText('7.50 V');
  await dashboard.type(dashboard.target(6), 1800);
  await expect(dashboard.estimate(6)).toHaveText('≈ 1800');
  await expect(dashboard.estimate(6)).toBeVisible();

  // Move, capture, play, send to the board: without scrolling.
  await dashboard.capture.click();
  for (const act of [
    ...[dashboard.slider(6), dashboard.capture, dashboard.button('Play'), dashboard.slot],
    ...['Download', 'Run', 'End group'].map((verb) => dashboard.button(verb)),
  ])
    await expect(act).toBeInViewport({ ratio: 1 });
});

test('a way that is not possible here says why', async ({ page, url }) => {
  vi.spyOn(window, 'isSecureContext', 'get').mockReturnValue(false);
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await dashboard.button('Connect').click();
  const dialog = dashboard.connectDialog;
  await expect(dialog.getByRole('group', { name: 'USB serial cable' })).toContainText(
    'This address is not secure, so the browser hides its serial ports.',
  );
  await expect(dialog.getByRole('group', { name: 'Gateway' })).toContainText(
    'No gateway answers at this address.',
  );
});

test('the simulated robot that is open is not offered once more, another board is', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await expect(dashboard.link).toHaveText(/Ready/);
  await dashboard.button('Connect').click();
  const simulated = dashboard.connectDialog.getByRole('group', { name: 'Simulated robot' });
  await expect(simulated.getByRole('button', { name: 'The simulated robot is open' })).toBeDisabled();
  await simulated.getByRole('combobox').selectOption('lsc-24');
  await simulated.getByRole('button', { name: 'Use the simulated robot' }).click();
  await dashboard.button('Connect').click();
  await expect(simulated.getByRole('combobox')).toHaveValue('lsc-24');
  await expect(simulated.getByRole('button', { name: 'The simulated robot is open' })).toBeDisabled();
});

test('who has a hexapod says so, and has one described', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await expect(dashboard.link).toHaveText(/Ready/);
  await dashboard.button('Connect').click();
  const { connectDialog } = dashboard;
  await expect(connectDialog.getByRole('radio', { name: 'Arm' })).toBeChecked();
  await connectDialog.getByRole('radio', { name: 'Hexapod' }).check();
  await expect(dashboard.slider(18)).toBeAttached();
  await expect(connectDialog.getByRole('heading', { level: 4 }).first()).toHaveText('USB cable of the board');
  await connectDialog.getByRole('combobox').selectOption('lsc-24');
  await connectDialog.getByRole('button', { name: 'Use the simulated robot' }).click();
  await expect(dashboard.bar).toContainText('Hexapod');
  await expect(dashboard.slider(18)).toBeAttached();
  await dashboard.button('Connect').click();
  await expect(connectDialog.getByRole('radio', { name: 'Hexapod' })).toBeChecked();
});

test('a person who looks for a fault finds what is there', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await expect(dashboard.link).toHaveText(/Ready/);
  await dashboard.button('Connect').click();
  const { connectDialog } = dashboard;
  await connectDialog.getByText('Something does not work?').click();
  await expect(connectDialog).toContainText('Serial ports: usable in this browser.');
  await expect(connectDialog).toContainText('Simulated board: Ready.');
  await expect(connectDialog).toContainText(/packets? of the board arrived/);
});

test('a chooser that is closed without a choice is no failure of the page', async ({ page, url }) => {
  vi.spyOn(navigator.serial, 'requestPort').mockRejectedValue(
    new DOMException('No port selected.', 'NotFoundError'),
  );
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await dashboard.button('Connect').click();
  await dashboard.button('Choose a port').click();
  await expect(dashboard.notices).toContainText('No port was chosen.');
  await expect(dashboard.connectDialog).toBeVisible();
});

test('the first press shows the other appearance, and it is remembered', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await dashboard.button('Appearance: As the system').click();
  await expect(dashboard.button('Appearance: Dark')).toBeVisible();
  await page.reload();
  await expect(dashboard.button('Appearance: Dark')).toBeVisible();
});
