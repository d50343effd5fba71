// The library: groups are kept by themselves, found again, brought back, moved, and never lost to somebody else's change.

import { readFile } from 'node:fs/promises';
import { emptyGroup } from '#shared/actions/group/group.ts';
import { libraryToText } from '#shared/actions/library/libraryText.ts';
import { bundle } from '../fixtures/robotInPage.ts';
import { captureGroup } from '../fixtures/group.ts';
import { dashboardOf, READY } from '../fixtures/dashboard.ts';
import { libraryOf } from '../fixtures/library.ts';
import { expect, poll, test } from '../fixtures/test.ts';

test('groups are kept by themselves, and a reload finds them with what is open @everyWay', async ({
  dashboard,
  page,
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

  await page.reload();
  await expect(library.groupName).toHaveValue('Bow one');
  await expect(dashboard.frames).toHaveCount(1);
  await library.show();
  await expect(library.card('Wave one')).toContainText('2 frames');
  await library.open('Wave one');
  await expect(dashboard.frames).toHaveCount(2);
});

test('each group keeps its own undo; versions, tags, copies and the trash work from the list', async ({
  dashboard,
  page,
}) => {
  const library = libraryOf(page);
  await captureGroup(dashboard, [1500]);
  await library.call('Salute');
  await library.show();
  await library.more('Salute');
  await library.write('Name of the version', 'One frame');
  await expect(library.button('Go back to One frame')).toBeVisible();
  await library.write('Tags of Salute', 'army, show');
  await library.dialog.getByRole('combobox', { name: 'Tag' }).selectOption('army');
  await poll(library.names).toEqual(['Salute']);
  await library.button('Duplicate').click();
  await poll(library.names).toEqual(['Salute, copy', 'Salute']);
  await library.open('Salute, copy');
  await dashboard.button('Capture frame').click();
  await expect(dashboard.frames).toHaveCount(2);

  await library.show();
  await library.open('Salute');
  await expect(dashboard.button('Undo: change tags')).toBeEnabled();
  await library.show();
  await library.open('Salute, copy');
  await dashboard.button('Undo: capture a frame').click();
  await expect(dashboard.frames).toHaveCount(1);

  await library.show();
  await library.more('Salute');
  await library.button('Delete').click();
  await expect(library.button('Open Salute')).toBeHidden();
  await dashboard.notices.getByRole('button', { name: 'Undo' }).click();
  await expect(library.button('Open Salute')).toBeVisible();
  await library.more('Salute, copy');
  await library.button('Delete').click();
  await library.dialog.getByRole('switch', { name: 'Deleted' }).check();
  await library.card('Salute, copy').getByRole('button', { name: 'Bring back' }).click();
  await library.dialog.getByRole('switch', { name: 'Deleted' }).uncheck();
  await library.open('Salute, copy');
});

test('of many groups those in sight are drawn, wherever the list is, and keys lead to each of them', async ({
  dashboard,
  page,
}) => {
  await captureGroup(dashboard, [1500]);
  const documents = Array.from({ length: 100 }, (_, index) => ({
    ...{ id: `many-${index}`, updatedAtMs: index, versions: [] },
    group: emptyGroup(`Step ${index + 1}`, 'us'),
  }));
  const library = libraryOf(page);
  await library.show();
  const choosing = page.waitForEvent('filechooser');
  await library.button('Import').click();
  await (
    await choosing
  ).setFiles({
    ...{ name: 'many.json', mimeType: 'application/json' },
    buffer: Buffer.from(libraryToText({ documents })),
  });
  const cards = library.list.getByRole('listitem');
  const named = library.list.getByRole('button', { name: /^Open / });
  await expect(cards.first()).toHaveAttribute('aria-setsize', /^[1-9]\d\d$/);
  const count = Number(await cards.first().getAttribute('aria-setsize'));
  expect((await library.names()).length).toBeLessThan(50);
  const [first] = await library.names();
  await named.first().press('End');
  await expect(cards.last()).toHaveAttribute('aria-posinset', String(count));
  await expect(cards.last().getByRole('button', { name: /^Open / })).toBeFocused();
  await expect(cards.last()).toBeInViewport();
  expect((await library.names()).length).toBeLessThan(50);
  expect(await library.names()).not.toContain(first);

  // Back by the arrow, card after card, to such that were not drawn before.
  for (let place = count; place > count - 40; place -= 1) {
    await expect(library.list.locator('li:focus-within')).toHaveAttribute('aria-posinset', String(place));
    await page.keyboard.press('ArrowUp');
  }
  // The wheel alone leaves nothing of what was seen behind it.
  await library.dialog.evaluate((dialog) => dialog.scrollTo({ top: dialog.scrollHeight }));
  await expect(cards.last()).toHaveAttribute('aria-posinset', String(count));
  await expect(cards.last()).toBeInViewport();
  expect((await library.names()).length).toBeLessThan(50);
  // What is looked for is found wherever it would stand.
  await library.dialog.getByRole('searchbox').fill('Step 1');
  await library.open('Step 1');
});

test.describe('at a gateway that is there late', () => {
  test.use({ expectedComplaint: /api\/(me|status) net::ERR_ABORTED/ });

  test('what was written meanwhile is kept there once it answers', async ({ dashboard, page }) => {
    const library = libraryOf(page);
    let isThere = false;
    await page.route(/\/api\/(me|status)$/, (route) => (isThere ? route.continue() : route.abort('aborted')));
    await page.reload();
    await expect(dashboard.link).toContainText('Ready', { timeout: 15_000 });
    await captureGroup(dashboard, [1500, 1700]);
    await library.call('Early');
    await library.show();
    await expect(library.dialog).toContainText('Until then each change is kept in this browser.');
    isThere = true;
    await expect(library.dialog).toContainText('Kept by the gateway');
    await expect(library.card('Early')).toContainText('2 frames');
    await page.keyboard.press('Escape');
    await dashboard.notices.getByRole('button', { name: 'Go to the gateway' }).click();
    await expect(dashboard.link).not.toContainText('Simulated');
    await expect(dashboard.link).toContainText('Ready');
  });
});

test('a gateway that has said who is here is waited for', async ({ dashboard, page }) => {
  await page.route(/\/api\/status$/, async (route) => {
    await new Promise((resolve) => setTimeout(resolve, 2500));
    await route.continue();
  });
  await page.reload();
  await expect(dashboard.link).toHaveText(READY, { timeout: 15_000 });
  await expect(dashboard.link).not.toContainText('Simulated');
});

test('a version is deleted alone, and comes back', async ({ dashboard, page }) => {
  const library = libraryOf(page);
  await captureGroup(dashboard, [1500]);
  await library.call('Greeting');
  await library.show();
  await library.more('Greeting');
  await library.write('Name of the version', 'First try');
  await expect(library.button('Go back to First try')).toBeVisible();
  await library.write('Name of the version', 'Second try');
  await library.button('Delete version First try').click();
  await expect(library.button('Go back to First try')).toBeHidden();
  await expect(library.button('Go back to Second try')).toBeVisible();
  await dashboard.notices.getByRole('button', { name: 'Undo' }).click();
  await expect(library.button('Go back to First try')).toBeVisible();
});

test('a version is renamed in its place, and back', async ({ dashboard, page }) => {
  const library = libraryOf(page);
  await captureGroup(dashboard, [1500]);
  await library.call('Farewell');
  await library.show();
  await library.more('Farewell');
  await library.write('Name of the version', 'Draft');
  await library.write('Name of version Draft', 'Before the show');
  await expect(library.button('Go back to Before the show')).toBeVisible();
  await expect(library.button('Go back to Draft')).toBeHidden();
  await page.reload();
  await library.show();
  await library.more('Farewell');
  await library.write('Name of version Before the show', 'Draft');
  await dashboard.notices.getByRole('button', { name: 'Undo' }).click();
  await expect(library.button('Go back to Before the show')).toBeVisible();
});

test.describe('two browsers at one gateway', () => {
  test.use({ expectedComplaint: /412/ });

  test('changes made at the same time are both kept, and the later one is told', async ({
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

    const context = await browser.newContext({ locale: 'en-GB', viewport: page.viewportSize() });
    const other = dashboardOf(await context.newPage());
    const theirs = libraryOf(other.page);
    await robot.open(other.page);
    await expect(other.link).toHaveText(READY);
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
    await context.close();
  });
});

test('a long name can be read to its end, also on a phone', async ({ dashboard, page }) => {
  const library = libraryOf(page);
  const name = 'Waves with both arms and bows, slowly, other version, copy';
  await captureGroup(dashboard, [1500]);
  await library.call(name);
  await library.show();
  for (const width of [1440, 390]) {
    await page.setViewportSize({ width, height: 844 });
    const shown = library.card(name).getByText(name, { exact: true });
    await expect(shown).toBeVisible();
    const hiddenPx = await shown.evaluate((element) => element.scrollWidth - element.clientWidth);
    expect(hiddenPx).toBeLessThanOrEqual(0);
  }
});

test('the whole library moves from the gateway into a browser as one file', async ({
  dashboard,
  page,
  browser,
  servers,
}) => {
  const library = libraryOf(page);
  await captureGroup(dashboard, [1500, 1600]);
  await library.call('Travelling');
  await library.show();
  await poll(library.names).toContain('Travelling');
  const downloading = page.waitForEvent('download');
  await library.button('Export').click();
  const file = await (await downloading).path();

  const context = await browser.newContext({ locale: 'en-GB', viewport: page.viewportSize() });
  const there = await context.newPage();
  await there.goto((await servers.files()).url);
  const away = libraryOf(there);
  await away.show();
  await expect(away.dialog).toContainText('Kept in this browser');
  await expect(away.dialog).toContainText('No groups in the library yet');
  const take = async (name: string, buffer: Buffer): Promise<void> => {
    const choosing = there.waitForEvent('filechooser');
    await away.button('Import').click();
    await (await choosing).setFiles({ name, mimeType: 'application/json', buffer });
  };
  const text = await readFile(file);
  await take('half.json', text.subarray(0, text.length / 2));
  await expect(there.getByRole('region', { name: 'Notices' })).toContainText('Nothing was taken');
  await take('library.json', text);
  await away.open('Travelling');
  await there.reload();
  await expect(away.groupName).toHaveValue('Travelling');
  await expect(dashboardOf(there).frames).toHaveCount(2);
  await context.close();
});

test.describe('the contract', () => {
  test.use({ expectedComplaint: /40[04]|412/ });

  for (const place of ['gateway', 'browser'] as const) {
    test(`every keeper does the same: ${place}`, async ({ newGateway, page }) => {
      const gateway = await newGateway();
      await page.addInitScript({
        content: await bundle('frontend/src/keepers/keepersUnderTest.ts', 'keepers'),
      });
      await page.goto(`${gateway.url}/docs`);
      const outcomes = await page.evaluate(
        (which) => (window as unknown as CheckWindow).checkKeeper(which),
        place,
      );
      expect(Object.keys(outcomes).length).toBeGreaterThan(5);
      expect(outcomes).toEqual(Object.fromEntries(Object.keys(outcomes).map((title) => [title, ''])));
    });
  }
});

interface CheckWindow {
  checkKeeper(which: 'gateway' | 'browser'): Promise<Record<string, string>>;
}
