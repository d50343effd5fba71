// The battery's settings are accessible and fit, and thresholds that cannot be are refused with words.

import { dashboardOf, expect, test } from './harness/test.ts';
import { expectSound, looks } from './harness/sound.ts';

for (const viewport of looks([
  { width: 390, height: 844 },
  { width: 820, height: 1180 },
  { width: 1440, height: 900 },
])) {
  test(`${viewport.width} px: the battery settings are accessible and fit`, async ({ page, url }) => {
    await page.setViewportSize(viewport);
    const dashboard = dashboardOf(page);
    await page.goto(url);
    await expect(dashboard.link).toContainText('Ready');
    if (viewport.width < 700) await page.getByRole('tab', { name: 'Board' }).click();
    await dashboard.button('Battery settings').click();
    await page.getByRole('radio', { name: 'Go to rest and stop' }).check();
    await expectSound('battery settings');
  });
}

for (const [field, typed] of [
  ['Alarm at, in millivolts', '7200'],
  ['Warn at, in millivolts', '6000'],
] as const) {
  test(`${field}: one the wrong way round is refused with words`, async ({ page, url }) => {
    const dashboard = dashboardOf(page);
    await page.goto(url);
    await expect(dashboard.link).toContainText('Ready');
    await dashboard.button('Battery settings').click();
    const number = page.getByRole('textbox', { name: field });
    const before = await number.inputValue();
    await number.fill(typed);
    await number.press('Enter');
    await expect(page.getByText(/battery alarm \d+ mV is not below its warning \d+ mV/u)).toBeVisible();
    await expect(number).toHaveValue(before);
  });
}
