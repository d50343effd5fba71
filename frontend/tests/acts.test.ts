// What happened at the gateway, as owners see it: who did what, what they may choose from, and what an empty list says.

import type { Page } from './harness/page.ts';
import { expect, test } from './harness/test.ts';

const at = (page: Page, url: string, state: string): Promise<unknown> =>
  page.goto(`${url}/gallery.html?language=en&state=${encodeURIComponent(state)}`);

test('each entry says who did what to whom, and what no person did', async ({ page, url }) => {
  await at(page, url, 'What happened');
  const entries = page.getByRole('list', { name: /^What happened/ }).getByRole('listitem');
  await expect(entries).toHaveCount(7);
  await expect(entries.nth(1)).toContainText('Gateway');
  await expect(entries.nth(1)).toContainText('Stopped the robot the driver was not heard');
  await expect(entries.nth(3)).toContainText('Moved servos 212 times');
  await expect(entries.nth(4)).toContainText('Changed a role iPhone · Driver');
  await expect(entries.nth(5)).toContainText('Unknown device');
  await expect(page.getByRole('button', { name: 'Show older' })).toBeEnabled();
  await expect(page.getByRole('button', { name: 'Export' })).toBeEnabled();
});

test('an empty list says why, and has nothing to export', async ({ page, url }) => {
  await at(page, url, 'What happened, nothing');
  await expect(page.getByText('Nothing has happened yet')).toBeVisible();
  await expect(page.getByRole('button', { name: 'Export' })).toBeDisabled();
  await at(page, url, 'What happened, none found');
  await expect(page.getByText('Nothing of this kind')).toBeVisible();
  await expect(page.getByRole('combobox', { name: 'Person' })).toHaveValue('Dance');
});

test('tokens say when they expire, and have a validity to choose', async ({ page, url }) => {
  await at(page, url, 'People, token shown');
  await expect(page.getByText('Expires in 12 days')).toBeVisible();
  await expect(page.getByText('Expired', { exact: true })).toBeVisible();
  await expect(page.getByRole('combobox', { name: 'Validity of the token' })).toHaveValue('month');
});
