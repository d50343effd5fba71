// The library that a gateway keeps: what one page stores another finds, changes of two at once are both kept, and a gateway
// that answers late loses nothing. What a page does with its library is tried as components.

import type { Browser, Page } from '@playwright/test';
import { bundle } from '../fixtures/robotInPage.ts';
import { captureGroup } from '../fixtures/group.ts';
import { anotherBrowser, dashboardOf, READY, type Dashboard } from '../fixtures/dashboard.ts';
import { libraryOf } from '../fixtures/library.ts';
import type { Robot } from '../fixtures/robot.ts';
import { expect, poll, test } from '../fixtures/test.ts';

/** In a browser of its own. */
async function openElsewhere(browser: Browser, page: Page, robot: Robot): Promise<Dashboard> {
  const context = await anotherBrowser(browser, { locale: 'en-GB', viewport: page.viewportSize() });
  const other = dashboardOf(await context.newPage());
  await robot.open(other.page);
  await expect(other.link).toHaveText(READY);
  return other;
}

test('what one page stores another finds, and a reload finds it with what is open', async ({
  dashboard,
  page,
  browser,
  robot,
}) => {
  const library = libraryOf(page);
  await captureGroup(dashboard, [1500, 1700]);
  await library.call('Wave one');
  await library.show();
  await library.button('New group').click();
  await captureGroup(dashboard, [1200]);
  await library.call('Bow one');
  await library.show();
  await poll(library.names).toEqual(expect.arrayContaining(['Bow one', 'Wave one']));
  await expect(library.dialog).not.toContainText('Not all changes');

  const other = await openElsewhere(browser, page, robot);
  const theirs = libraryOf(other.page);
  await theirs.show();
  await expect(theirs.card('Wave one')).toContainText('2 frames');
  await theirs.open('Wave one');
  await expect(other.frames).toHaveCount(2);
  await other.page.context().close();

  await page.reload();
  await expect(library.groupName).toHaveValue('Bow one');
  await expect(dashboard.frames).toHaveCount(1);
});

test.describe('at a gateway that is there late', () => {
  test.use({ expectedComplaint: /api\/(me|status) net::ERR_ABORTED/ });

  test('what was written meanwhile is kept there once it answers @exhaustive', async ({
    dashboard,
    page,
  }) => {
    const library = libraryOf(page);
    let isThere = false;
    await page.route(/\/api\/(me|status)$/, (route) => (isThere ? route.continue() : route.abort('aborted')));
    await page.reload();
    await expect(dashboard.link).toContainText('Ready', { timeout: 15_000 });
    await captureGroup(dashboard, [1500, 1700]);
    await library.call('Early');
    await library.show();
    await expect(library.dialog).toContainText('Until it answers, every change is stored in this browser.');
    isThere = true;
    await expect(library.dialog).toContainText('Stored by the gateway');
    await expect(library.card('Early')).toContainText('2 frames');
    await page.keyboard.press('Escape');
    await dashboard.notices.getByRole('button', { name: 'Connect to the gateway' }).click();
    await expect(dashboard.link).not.toContainText('Simulated');
    await expect(dashboard.link).toContainText('Ready');
  });
});

test('a gateway that has said who is here is waited for @exhaustive', async ({ dashboard, page }) => {
  await page.route(/\/api\/status$/, async (route) => {
    await new Promise((resolve) => setTimeout(resolve, 2500));
    await route.continue();
  });
  await page.reload();
  await expect(dashboard.link).toHaveText(READY, { timeout: 15_000 });
  await expect(dashboard.link).not.toContainText('Simulated');
});

test.describe('two browsers at one gateway', () => {
  test.use({ expectedComplaint: /412/ });

  test('changes made at the same time are both kept, and the later one is reported @exhaustive', async ({
    dashboard,
    page,
    browser,
    robot,
  }) => {
    const library = libraryOf(page);
    await captureGroup(dashboard, [1500]);
    await library.call('Duet');
    await library.show();
    await poll(library.names).toContain('Duet');
    await library.close();

    const other = await openElsewhere(browser, page, robot);
    const theirs = libraryOf(other.page);
    await theirs.show();
    await theirs.open('Duet');

    await other.type(other.frameTime(1), 700);
    await theirs.show();
    await expect(theirs.dialog).not.toContainText('Not all changes');
    await expect(theirs.card('Duet')).toContainText('0.7 sec');
    // The focus that would make this page follow stays away from it: it changes what it still shows.
    await dashboard.type(dashboard.frameTime(1), 900);

    await expect(dashboard.notices).toContainText('changed elsewhere at the same time');
    await expect(library.groupName).toHaveValue('Duet, other version');
    await expect(dashboard.frameTime(1)).toHaveValue('900');
    await library.show();
    await expect(library.card('Duet')).toContainText('0.7 sec');
    await expect(library.card('Duet, other version')).toContainText('0.9 sec');
    await expect(theirs.card('Duet, other version')).toContainText('0.9 sec');
    await other.page.context().close();
  });
});

test.describe('the contract', () => {
  test.use({ expectedComplaint: /40[04]|412/ });

  test('a gateway keeps what a browser keeps, in the same way', async ({ newGateway, page }) => {
    const gateway = await newGateway();
    await page.addInitScript({
      content: await bundle('frontend/src/features/library/gatewayStoreUnderTest.ts', 'stores'),
    });
    await page.goto(`${gateway.url}/docs`);
    const outcomes = await page.evaluate(() => (window as unknown as CheckWindow).checkStore());
    expect(Object.keys(outcomes).length).toBeGreaterThan(5);
    expect(outcomes).toEqual(Object.fromEntries(Object.keys(outcomes).map((title) => [title, ''])));
  });
});

interface CheckWindow {
  checkStore(): Promise<Record<string, string>>;
}
