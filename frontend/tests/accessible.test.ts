// Every main state in every layout: axe finds nothing to object to, nothing has to be scrolled sideways, and what is as long as
// it may be fits. The parts alone are looked at in the gallery.

import * as robotDialog from '../../e2e/fixtures/robotDialog.ts';
import * as libraries from '../../e2e/fixtures/library.ts';
import { filesDialogOf, vector } from './filesDialog.ts';
import type { Locator } from './harness/locator.ts';
import type { Page } from './harness/page.ts';
import { expectNoSidewaysScroll, expectSound, isExhaustive, looks } from './harness/sound.ts';
import { dashboardOf, expect, here, poll, test, type Dashboard } from './harness/test.ts';
import { advance } from './harness/time.ts';

const { robotDialogOf } = here(robotDialog);
const libraryOf = here(libraries.libraryOf);

const PHONE = { width: 390, height: 844 };
const TABLET = { width: 820, height: 1180 };
const DESKTOP = { width: 1440, height: 900 };
const WORKSPACES = ['Drive', 'Board', 'Animate'];
const TABS = ['Animate', 'Board', 'Log', 'Buttons', 'Drive'];

interface Look {
  readonly page: Page;
  readonly isDark: boolean;
}

async function opened(page: Page, url: string): Promise<Dashboard> {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await expect(dashboard.link).toContainText('Ready');
  await advance(2600);
  return dashboard;
}

const isPhone = (page: Page): Promise<boolean> =>
  page.getByRole('tablist', { name: 'Workspaces' }).isVisible();

async function toTab(page: Page, name: string): Promise<void> {
  if (await isPhone(page)) await page.getByRole('tab', { name }).click();
  else await page.getByRole('radio', { name, exact: true }).check();
}

async function expectSoundPages({ page, isDark }: Look): Promise<void> {
  await toTab(page, 'Animate');
  await page.getByRole('radio', { name: 'Poses' }).check();
  await expectSound('poses', { isDark });
  await page.getByRole('radio', { name: 'Keys and pad' }).check();
  await expectSound('keys and pad', { isDark });
  await toTab(page, 'Buttons');
  await page.getByRole('button', { name: 'Add button' }).click();
  await page.getByRole('button', { name: 'Slot' }).click();
  await expectSound('buttons being changed', { isDark });
  await page.getByRole('button', { name: 'Kiosk' }).click();
  await expectSound('kiosk', { isDark });
}

/** Each workspace, or each tab of a phone. */
async function expectSoundEverywhere({ page, isDark }: Look, state: string): Promise<void> {
  for (const tab of (await isPhone(page)) ? TABS : WORKSPACES) {
    await toTab(page, tab);
    await expectSound(`${state} ${tab}`, { isDark });
  }
}

async function expectRobotsSound({ page, isDark }: Look): Promise<void> {
  const robots = robotDialogOf(dashboardOf(page));
  await robots.opener.click();
  await expect(robots.dialog).toBeVisible();
  await expectSound('robots', { isDark });
  await robots.button('Edit').click();
  await robots.cell('Lowest', 'Elbow').fill('2600');
  await robots.cell('Lowest', 'Elbow').press('Enter');
  await expectSound('servos of a robot', { isDark });
  await robots.button('All robots').click();
  await robots.button('Calibrate').click();
  await expectSound('calibration', { isDark });
  await robots.button('Direction').click();
  await expectSound('direction', { isDark });
  // Not by mouse: it would rest on what lies behind, whose hint would show in the next state.
  await robots.button('Close').press('Enter');
  await expect(robots.dialog).toBeHidden();
  await page.mouse.move(0, 400);
}

async function expectLibrarySound({ page, isDark }: Look): Promise<void> {
  const library = libraryOf(page);
  await toTab(page, 'Animate');
  await library.show();
  await expectSound('empty library', { isDark });
  await library.close();
  await library.call('Wave');
  await library.show();
  await library.more('Wave');
  await library.write('Name of the version', 'First');
  await expect(library.button('Go back to First')).toBeVisible();
  await expectSound('library', { isDark });
}

const heightOf = (place: Locator): Promise<number> => place.evaluate(({ clientHeight }) => clientHeight);

for (const colorScheme of looks(['light', 'dark'])) {
  for (const viewport of isExhaustive ? [PHONE, TABLET, DESKTOP] : [PHONE, DESKTOP]) {
    test.describe(`${viewport.width} px, ${colorScheme}`, () => {
      test.override({ viewport, media: { colorScheme } });
      const isDark = colorScheme === 'dark';

      test('every main state is accessible and fits', async ({ page, url }) => {
        const dashboard = await opened(page, url);
        await expect(dashboard.bar).toContainText('7.50 V');
        const readyPx = await heightOf(dashboard.bar);
        await expectSoundEverywhere({ page, isDark }, 'ready');

        await expectRobotsSound({ page, isDark });

        await page.keyboard.press('Escape');
        await expect(dashboard.resume).toBeVisible();
        await expectSound('stopped', { isDark });

        await dashboard.link.click();
        await expect(dashboard.connectDialog).toBeVisible();
        await expectSound('connect dialog', { isDark });

        await dashboard.button('Disconnect').click();
        await expect(dashboard.link).toContainText('No robot');
        await expectSound('disconnected', { isDark });
        // Nothing below it jumps.
        await poll(() => heightOf(dashboard.bar)).toBe(readyPx);
      });

      test('the library is accessible and fits', async ({ page, url }) => {
        await opened(page, url);
        await expectLibrarySound({ page, isDark });
      });

      test('poses, buttons and the kiosk are accessible and fit', async ({ page, url }) => {
        await opened(page, url);
        await expectSoundPages({ page, isDark });
      });
    });
  }
}

for (const viewport of looks([PHONE, TABLET, DESKTOP]))
  test.describe(`${viewport.width} px`, () => {
    test.override({ viewport });

    test('files are accessible and fit', async ({ page, url }) => {
      const dashboard = await opened(page, url);
      await toTab(page, 'Animate');
      const names = ['No.10 wave.xml', 'step.rob', 'secret.rob'];
      await filesDialogOf(dashboard).open(...(await Promise.all(names.map(vector))));
      await expect(page.getByText('secret.rob was not opened.')).toBeVisible();
      await expectSound('files');
    });

    test('names as long as they may be, without a space, fit', async ({ page, url }) => {
      const dashboard = await opened(page, url);
      const name = 'W'.repeat(64);
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
      await expectNoSidewaysScroll('robots');
      await robots.button('Calibrate').click();
      await expect(robots.dialog.getByRole('heading', { name })).toBeVisible();
      await expectNoSidewaysScroll('calibration');
      await robots.button('Close').click();
      await toTab(page, 'Animate');
      await libraryOf(page).call(name);
      await dashboard.capture.click();
      await dashboard.button('Files').click();
      await expect(dashboard.button(`Save ${name}.json`)).toBeVisible();
      await expectNoSidewaysScroll('files');
    });

    test('the dials of 32 servos leave what is around them alone', async ({ page, url }) => {
      await page.goto(`${url}/gallery.html?state=Thirty-two%20servos`);
      const dials = page
        .getByRole('list')
        .filter({ has: page.getByRole('img', { name: 'Dial of servo 32' }) })
        .first();
      const legend = page.getByRole('list', { name: 'Meaning of the marks' });
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
  });

test('nothing has to be scrolled sideways from 390 to 1920 px, and the sliders are what is widest', async ({
  page,
  url,
}) => {
  const dashboard = await opened(page, url);
  await toTab(page, 'Drive');
  const widthOf = (place: Locator): Promise<number> =>
    place.evaluate((element) => element.getBoundingClientRect().width);
  for (const width of [390, 430, 600, 699, 700, 820, 1024, 1099, 1100, 1280, 1440, 1920]) {
    await page.setViewportSize({ width, height: 900 });
    await expectNoSidewaysScroll(`${width} px`);
    const share = async (): Promise<number> =>
      (await widthOf(dashboard.slider(1))) / (await widthOf(dashboard.target(1)));
    await poll(share, { message: `${width} px: the slider beside its number` }).toBeGreaterThan(2);
  }
});
