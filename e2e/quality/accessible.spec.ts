// Every main state in every layout, light and dark: axe finds nothing to object to, and nothing has to be scrolled
// sideways.

import { AxeBuilder } from '@axe-core/playwright';
import type { Locator, Page } from '@playwright/test';
import { at } from '../../scripts/steps.mjs';
import { dashboardOf } from '../fixtures/dashboard.ts';
import { libraryOf } from '../fixtures/library.ts';
import { robotDialogOf } from '../fixtures/robotDialog.ts';
import { expect, poll, test } from '../fixtures/test.ts';

const SIZES = [
  { width: 390, height: 844 },
  { width: 820, height: 1180 },
  { width: 1440, height: 900 },
];
const TABS = ['Actions', 'Board', 'Log', 'Buttons', 'Live'];

/** What is drawn anew after a change is looked at until it is right. */
const softly = expect.configure({ soft: true });

interface Look {
  readonly page: Page;
  readonly isDark: boolean;
}

async function expectSound({ page, isDark }: Look, state: string): Promise<void> {
  // Without frames on the page the plain mode finds the same and needs no second page for its report.
  const axe = new AxeBuilder({ page }).setLegacyMode();
  // Dark differs from light in its colours only.
  if (isDark) axe.withRules('color-contrast');
  const { violations } = await axe.analyze();
  const found = violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(' | ')}`);
  expect.soft(found, state).toEqual([]);
  await expectNoSidewaysScroll(page, state);
}

async function expectNoSidewaysScroll(page: Page, state: string): Promise<void> {
  const overflow = (): Promise<number> =>
    page.evaluate(() =>
      [document.documentElement, ...document.querySelectorAll('[role="dialog"], [role="alertdialog"]')]
        .map(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth)
        .reduce((most, pixels) => Math.max(most, pixels)),
    );
  await softly.poll(overflow, { message: `${state}: pixels beyond the right edge` }).toBe(0);
}

/** Where the screen has no tabs for it, the page of buttons is chosen above. */
async function expectSoundPages(look: Look): Promise<void> {
  const { page } = look;
  const isPhone = await page.getByRole('tablist').isVisible();
  if (isPhone) await page.getByRole('tab', { name: 'Actions' }).click();
  await page.getByRole('radio', { name: 'Poses' }).check();
  await expectSound(look, 'poses');
  await page.getByRole('radio', { name: 'Keys and pad' }).check();
  await expectSound(look, 'keys and pad');
  if (isPhone) await page.getByRole('tab', { name: 'Buttons' }).click();
  else await page.getByRole('radio', { name: 'Buttons' }).check();
  await page.getByRole('button', { name: 'Add button' }).click();
  await page.getByRole('button', { name: 'Slot' }).click();
  await expectSound(look, 'buttons being changed');
  await page.getByRole('button', { name: 'Kiosk' }).click();
  await expectSound(look, 'kiosk');
}

/** On a phone each part by itself. */
async function expectSoundEverywhere(look: Look, state: string): Promise<void> {
  const { page } = look;
  const isPhone = await page.getByRole('tablist', { name: 'Parts of the dashboard' }).isVisible();
  for (const tab of isPhone ? TABS : ['']) {
    if (isPhone) await page.getByRole('tab', { name: tab }).click();
    await expectSound(look, `${state} ${tab}`);
  }
}

const heightOf = (place: Locator): Promise<number> => place.evaluate(({ clientHeight }) => clientHeight);

const widthOf = (place: Locator): Promise<number> =>
  place.evaluate((element) => element.getBoundingClientRect().width);

async function expectRobotsSound(look: Look): Promise<void> {
  const robots = robotDialogOf(dashboardOf(look.page));
  await robots.opener.click();
  await expectSound(look, 'robots');
  await robots.button('Edit').click();
  await robots.cell('Lowest', 'Elbow').fill('2600');
  await robots.cell('Lowest', 'Elbow').press('Enter');
  await expectSound(look, 'servos of a robot');
  await robots.button('All robots').click();
  await robots.button('Calibrate').click();
  await expectSound(look, 'calibration');
  await robots.button('Direction').click();
  await expectSound(look, 'direction');
  // Not by mouse: it would rest on what lies behind, whose hint would show in the next state.
  await robots.button('Close').press('Enter');
  await expect(robots.dialog).toBeHidden();
  await look.page.mouse.move(0, 400);
}

async function expectLibrarySound(look: Look): Promise<void> {
  const { page } = look;
  const library = libraryOf(page);
  if (await page.getByRole('tablist').isVisible()) await page.getByRole('tab', { name: 'Actions' }).click();
  await library.show();
  await expectSound(look, 'empty library');
  await library.close();
  await library.call('Wave');
  await library.show();
  await library.more('Wave');
  await library.write('Name of the version', 'First');
  await expect(library.button('Go back to First')).toBeVisible();
  await expectSound(look, 'library');
}

for (const colorScheme of ['light', 'dark'] as const) {
  for (const viewport of SIZES) {
    test.describe(`${viewport.width} px, ${colorScheme}`, () => {
      test.use({ colorScheme, viewport, contextOptions: { reducedMotion: 'reduce' } });

      test('every main state is accessible and fits', async ({ page, servers }) => {
        test.slow();
        const dashboard = dashboardOf(page);
        const look = { page, isDark: colorScheme === 'dark' };
        await page.goto((await servers.files()).url);
        await expect(dashboard.link).toContainText('Ready');
        await expect(dashboard.bar).toContainText('7.50 V');
        await page.evaluate(() => document.fonts.ready);
        const readyPx = await heightOf(dashboard.bar);
        await expectSoundEverywhere(look, 'ready');

        await expectRobotsSound(look);

        await page.keyboard.press('Escape');
        await expect(dashboard.resume).toBeVisible();
        await expectSound(look, 'stopped');

        await dashboard.link.click();
        await expect(dashboard.connectDialog).toBeVisible();
        await expectSound(look, 'connect dialog');

        await dashboard.button('Disconnect').click();
        await expect(dashboard.link).toContainText('No robot');
        await expectSound(look, 'disconnected');
        // Nothing below it jumps.
        await poll(() => heightOf(dashboard.bar)).toBe(readyPx);
      });

      test('the library is accessible and fits', async ({ page, servers }) => {
        await page.goto((await servers.files()).url);
        await expect(dashboardOf(page).link).toContainText('Ready');
        await expectLibrarySound({ page, isDark: colorScheme === 'dark' });
      });

      test('poses, buttons and the kiosk are accessible and fit', async ({ page, servers }) => {
        await page.goto((await servers.files()).url);
        await expect(dashboardOf(page).link).toContainText('Ready');
        await expectSoundPages({ page, isDark: colorScheme === 'dark' });
      });
    });
  }
}

for (const viewport of SIZES) {
  test(`${viewport.width} px: files are accessible and fit`, async ({ page, servers }) => {
    await page.setViewportSize(viewport);
    const dashboard = dashboardOf(page);
    await page.goto((await servers.files()).url);
    await expect(dashboard.link).toContainText('Ready');
    if (viewport.width < 700) await page.getByRole('tab', { name: 'Actions' }).click();
    await dashboard.button('Files').click();
    const choosing = page.waitForEvent('filechooser');
    await dashboard.button('Choose files').click();
    const names = ['No.10 wave.xml', 'step.rob', 'secret.rob'];
    await (await choosing).setFiles(names.map((name) => at(`shared/vectors/files/${name}`)));
    await expect(page.getByText('secret.rob was not opened.')).toBeVisible();
    await expectSound({ page, isDark: false }, 'files');
  });
}

test('nothing has to be scrolled sideways from 390 to 1920 px, and the sliders are what is widest', async ({
  page,
  servers,
}) => {
  const dashboard = dashboardOf(page);
  await page.goto((await servers.files()).url);
  await expect(dashboard.link).toContainText('Ready');
  for (const width of [390, 430, 600, 699, 700, 820, 1024, 1099, 1100, 1280, 1440, 1920]) {
    await page.setViewportSize({ width, height: 900 });
    await expectNoSidewaysScroll(page, `${width} px`);
    const share = async (): Promise<number> =>
      (await widthOf(dashboard.slider(1))) / (await widthOf(dashboard.target(1)));
    await softly.poll(share, { message: `${width} px: the slider beside its number` }).toBeGreaterThan(2);
  }
});

for (const viewport of SIZES) {
  test(`${viewport.width} px: names as long as they may be, without a space, fit`, async ({
    page,
    servers,
  }) => {
    await page.setViewportSize(viewport);
    const dashboard = dashboardOf(page);
    const name = 'W'.repeat(64);
    await page.goto((await servers.files()).url);
    await expect(dashboard.link).toContainText('Ready');
    const robots = robotDialogOf(dashboard);
    await robots.opener.click();
    await robots.button('Edit').click();
    for (const field of [
      robots.cell('Name', 'Gripper'),
      robots.dialog.getByRole('textbox', { name: 'Name of the robot' }),
    ]) {
      await field.fill(name);
      await field.press('Enter');
    }
    await robots.button('All robots').click();
    await expectNoSidewaysScroll(page, 'robots');
    await robots.button('Calibrate').click();
    await expect(robots.dialog.getByRole('heading', { name })).toBeVisible();
    await expectNoSidewaysScroll(page, 'calibration');
    await robots.button('Close').click();
    if (viewport.width < 700) await page.getByRole('tab', { name: 'Actions' }).click();
    await libraryOf(page).call(name);
    await dashboard.capture.click();
    await dashboard.button('Files').click();
    await expect(dashboard.button(`Save ${name}.json`)).toBeVisible();
    await expectNoSidewaysScroll(page, 'files');
  });

  test(`${viewport.width} px: the dials of 32 servos leave what is around them alone`, async ({
    page,
    servers,
  }) => {
    await page.setViewportSize(viewport);
    await page.goto(`${(await servers.files()).url}/gallery.html?state=Thirty-two%20servos`);
    const dials = page
      .getByRole('list')
      .filter({ has: page.getByRole('img', { name: 'Dial of servo 32' }) })
      .first();
    const legend = page.getByRole('list', { name: 'What the marks mean' });
    const legendBox = (): Promise<DOMRect> => legend.evaluate((list) => list.getBoundingClientRect());
    const seenTo = (): Promise<number> =>
      dials.evaluate((list) => {
        let bottom = list.getBoundingClientRect().bottom;
        for (let around = list.parentElement; around !== null; around = around.parentElement)
          if (getComputedStyle(around).overflowY !== 'visible')
            bottom = Math.min(bottom, around.getBoundingClientRect().bottom);
        return bottom;
      });
    const dialsTop = (): Promise<number> => dials.evaluate((list) => list.getBoundingClientRect().top);
    await poll(async () => {
      const { top, bottom } = await legendBox();
      return Math.max(top - (await seenTo()), (await dialsTop()) - bottom);
    }).toBeGreaterThan(0);
  });
}
