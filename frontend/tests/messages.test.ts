// A message has room of its own: whatever could be pressed before it came can be pressed beside it. A hint has not, so it lets
// everything through and never lies over STOP.

import type { Page } from './harness/page.ts';
import { dashboardOf, expect, poll, test } from './harness/test.ts';

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
  test(`messages cover no control at ${size.width} pixels`, async ({ page, url }) => {
    await page.setViewportSize(size);
    const dashboard = dashboardOf(page);
    await page.goto(url);
    await expect(dashboard.link).toHaveText(/Simulated/);
    await dashboard.type(dashboard.target(1), 9999);
    await expect(dashboard.notices).toContainText('Gripper: 9999 is out of range; it takes 500 to 2500.');
    await dashboard.type(dashboard.target(2), 9998);
    await expect(dashboard.notices).toContainText(/\d more/);
    await poll(() => coveredBy(page)).toEqual([]);
    await dashboard.notices.getByRole('button', { name: 'Dismiss' }).click();
    await expect(dashboard.notices.getByRole('listitem')).toHaveText(/Gripper/);
  });
}

/** Where a finger or the pointer would not meet STOP, though it is drawn there; of a grid over the button. */
function coveredStop(page: Page): Promise<readonly string[]> {
  return page.evaluate(() => {
    const stop = document.querySelector('button[aria-keyshortcuts="Escape"]');
    const { x, y, width, height } = stop?.getBoundingClientRect() ?? new DOMRect();
    const shares = [0.05, 0.25, 0.5, 0.75, 0.95];
    return shares
      .flatMap((across) =>
        shares.map((down) => document.elementFromPoint(x + width * across, y + height * down)),
      )
      .filter((met) => !stop?.contains(met))
      .map((met) => met?.outerHTML ?? 'nothing');
  });
}

test('no hint lies over Stop or takes a press', async ({ page, url }) => {
  await page.goto(url);
  const dashboard = dashboardOf(page);
  await expect(dashboard.link).toHaveText(/Simulated/);
  const appearance = dashboard.bar.getByRole('button', { name: /^Appearance/ });
  // As wide as any: where it hangs is the library's, whom it covers is ours.
  await page.evaluate(() => {
    const style = document.createElement('style');
    style.textContent = '[role="tooltip"] { width: 280px; height: 60px; }';
    document.body.append(style);
  });
  await page.mouse.move(600, 400);
  await appearance.hover();
  const hint = page.getByRole('tooltip');
  await expect(hint).toBeVisible();
  const liesOver = async (): Promise<boolean> => {
    const [box, stop] = [await hint.boundingBox(), await dashboard.stop.boundingBox()];
    return box.x + box.width > stop.x && box.y < stop.y + stop.height;
  };
  await expect.poll(liesOver).toBe(true);
  expect(await coveredStop(page)).toEqual([]);
  await expect(hint).toHaveCSS('pointer-events', 'none');
});

test('a message dismissed by key gives the focus back', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  await page.goto(url);
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
