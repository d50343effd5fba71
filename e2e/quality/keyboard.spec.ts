// The main job by keyboard alone: every control is reached by Tab in reading order, the focus is always to be seen.

import type { Locator, Page } from '@playwright/test';
import { dashboardOf } from '../fixtures/dashboard.ts';
import { expect, test } from '../fixtures/test.ts';

/** More than there are stops on the page. */
const MOST_TABS = 80;

/** Presses Tab until `wanted` has the focus. */
async function tabTo(page: Page, wanted: Locator): Promise<void> {
  for (let presses = 0; presses < MOST_TABS; presses += 1) {
    if (await holdsFocus(wanted)) return;
    await page.keyboard.press('Tab');
  }
  throw new Error(`Tab does not lead to ${String(wanted)}`);
}

function holdsFocus(place: Locator): Promise<boolean> {
  return place.evaluate((element) => element.contains(document.activeElement));
}

test('the main job needs no mouse', async ({ page, servers }) => {
  const dashboard = dashboardOf(page);
  const { keyboard } = page;
  await page.goto((await servers.files()).url);
  await expect(dashboard.link).toHaveText(/Ready/);
  await expect(dashboard.estimate(6)).toHaveText('≈ 1500');

  await tabTo(page, dashboard.slider(6));
  await keyboard.press('PageUp');
  await expect(dashboard.estimate(6)).toHaveText('≈ 1600');
  await tabTo(page, dashboard.capture);
  await keyboard.press('Enter');
  await keyboard.press('Enter');
  await expect(dashboard.frames).toHaveCount(2);
  await tabTo(page, dashboard.slot);
  await keyboard.press('ControlOrMeta+a');
  await keyboard.type('5');
  await tabTo(page, dashboard.button('Download'));
  await keyboard.press('Enter');
  await expect(dashboard.notices).toContainText('Slot 5 is downloaded.');
  await tabTo(page, dashboard.untilStopped);
  await keyboard.press('Space');
  await tabTo(page, dashboard.button('Run'));
  await keyboard.press('Enter');
  await expect(dashboard.status).toContainText('Running slot 5, until stopped');
  await tabTo(page, dashboard.stop);
  await keyboard.press('Enter');
  await expect(dashboard.status).toContainText('Stop sent');
  await tabTo(page, dashboard.resume);
  await keyboard.press('Enter');
  await expect(dashboard.status).toHaveText('Idle');
});

test('a dialog shares the focus with STOP alone, and gives it back', async ({ page, servers }) => {
  const dashboard = dashboardOf(page);
  await page.goto((await servers.files()).url);
  await tabTo(page, dashboard.button('Connect'));
  await page.keyboard.press('Enter');
  await expect(dashboard.connectDialog).toBeVisible();
  const stops = [dashboard.connectDialog, dashboard.stop];
  for (let presses = 0; presses < 12; presses += 1) {
    await page.keyboard.press('Tab');
    const holds = await Promise.all(stops.map(holdsFocus));
    expect(holds).toContain(true);
  }
  await dashboard.connectDialog.getByRole('button', { name: 'Close' }).press('Enter');
  await expect(dashboard.button('Connect')).toBeFocused();
});
