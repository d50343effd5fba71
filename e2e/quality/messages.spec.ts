// A message has room of its own: whatever could be pressed before it came can be pressed beside it.

import type { Page } from '@playwright/test';
import { dashboardOf } from '../fixtures/dashboard.ts';
import { expect, test } from '../fixtures/test.ts';

const SIZES = [
  { width: 390, height: 844 },
  { width: 820, height: 1180 },
  { width: 1440, height: 900 },
];

/** The controls whose middle lies under a message; what is scrolled out of its part of the page is not under it. */
function coveredBy(page: Page): Promise<readonly string[]> {
  return page.evaluate(() => {
    const messages = document.querySelector('[aria-label="Notices"]');
    return [...document.querySelectorAll('button, input, select, [role="tab"]')]
      .filter((control) => !messages?.contains(control))
      .filter((control) => {
        const { x, y, width, height } = control.getBoundingClientRect();
        const end = control.closest('main')?.getBoundingClientRect().bottom ?? Infinity;
        const under = document.elementFromPoint(x + width / 2, y + height / 2);
        return y + height / 2 < end && under !== null && messages?.contains(under);
      })
      .map((control) => control.outerHTML);
  });
}

for (const size of SIZES) {
  test(`messages cover no control at ${size.width} pixels`, async ({ page, servers }) => {
    await page.setViewportSize(size);
    const dashboard = dashboardOf(page);
    await page.goto((await servers.files()).url);
    await expect(dashboard.link).toHaveText(/Simulated/);
    await dashboard.type(dashboard.target(1), 9999);
    await expect(dashboard.notices).toContainText('Gripper: 9999 is out of range; it takes 500 to 2500.');
    await dashboard.type(dashboard.target(2), 9998);
    await expect(dashboard.notices).toContainText(/\d more/);
    expect(await coveredBy(page)).toEqual([]);
    await dashboard.notices.getByRole('button', { name: 'Dismiss' }).click();
    await expect(dashboard.notices.getByRole('listitem')).toHaveText(/Gripper/);
  });
}

test('whoever dismisses a message by key is back where they came from', async ({ page, servers }) => {
  const dashboard = dashboardOf(page);
  await page.goto((await servers.files()).url);
  await expect(dashboard.link).toHaveText(/Simulated/);
  await dashboard.type(dashboard.target(1), 9999);
  await page.keyboard.press('Shift+Tab');
  await expect(dashboard.slider(1)).toBeFocused();
  const dismiss = dashboard.notices.getByRole('button', { name: 'Dismiss' });
  await dismiss.focus();
  await page.keyboard.press('Enter');
  await expect(dismiss).toBeHidden();
  await expect(dashboard.slider(1)).toBeFocused();
});
