// What a control is for shows where the pointer rests and where the keyboard is, and is gone as soon as anything is done.

import type { Locator } from './harness/locator.ts';
import type { Page } from './harness/page.ts';
import { dashboardOf, expect, test } from './harness/test.ts';

const hintIn = (page: Page): Locator => page.getByRole('tooltip');

test('a hint shows where the pointer rests, follows it, and goes with a press', async ({ page, url }) => {
  await page.goto(url);
  const { bar, link } = dashboardOf(page);
  await expect(link).toHaveText(/Simulated/);
  const appearance = bar.getByRole('button', { name: /^Appearance/ });
  const tools = page.getByRole('toolbar', { name: 'Change the timeline' });
  await appearance.hover();
  await expect(hintIn(page)).toHaveText(/^Appearance/);
  await tools.getByRole('button', { name: 'Snap', exact: true }).hover();
  await expect(hintIn(page)).toHaveText(/Alt/);
  await expect(tools.getByRole('button', { name: 'Snap', exact: true })).toHaveAccessibleDescription(/Alt/);
  await page.mouse.down();
  await expect(hintIn(page)).toBeHidden();
  await page.mouse.up();
  await page.mouse.move(700, 400);
  await expect(hintIn(page)).toBeHidden();
});

test('a hint shows at what the keyboard leads to, and goes with the next key', async ({ page, url }) => {
  await page.goto(url);
  const { bar, link } = dashboardOf(page);
  await expect(link).toHaveText(/Simulated/);
  const appearance = bar.getByRole('button', { name: /^Appearance/ });
  await appearance.focus();
  await page.keyboard.press('Shift+Tab');
  await page.keyboard.press('Tab');
  await expect(appearance).toBeFocused();
  await expect(hintIn(page)).toHaveText(/^Appearance/);
  await page.keyboard.press('Escape');
  await expect(hintIn(page)).toBeHidden();
});

test('a hint names the key that does the same, and why a button cannot be pressed now', async ({
  page,
  url,
}) => {
  await page.goto(url);
  const { link } = dashboardOf(page);
  await expect(link).toHaveText(/Simulated/);
  const tools = page.getByRole('toolbar', { name: 'Change the timeline' });
  await tools.getByRole('button', { name: 'Set key', exact: true }).hover();
  await expect(hintIn(page)).toHaveText('Set keyEnter');
  const remove = tools.getByRole('button', { name: 'Delete keys', exact: true });
  await remove.hover();
  await expect(hintIn(page)).toHaveText(/Delete.*Select keys or a marker first\.$/);
  await expect(remove).toHaveAccessibleDescription('Select keys or a marker first.');
});
