// The library: groups are kept by themselves, found again, brought back and moved. Here it is the browser's own; what is the
// gateway's part is tried end to end.

import { emptyGroup } from '#shared/group/group.ts';
import { libraryToText } from '#shared/files/libraryText.ts';
import * as group from '../../e2e/fixtures/group.ts';
import * as libraries from '../../e2e/fixtures/library.ts';
import type { Page } from './harness/page.ts';
import { expect, here, poll, test } from './harness/test.ts';

const { captureGroup } = here(group);
const { libraryOf } = here(libraries);

async function importInto({ button }: ReturnType<typeof libraryOf>, page: Page, text: string): Promise<void> {
  const choosing = page.waitForEvent('filechooser');
  await button('Import').click();
  await (await choosing).setFiles({ name: 'library.json', buffer: new TextEncoder().encode(text) });
}

test('groups are kept by themselves, and a reload finds them with what is open', async ({
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
  await poll(async () => (await library.names()).toSorted()).toEqual(['Bow one', 'Wave one']);
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
  await expect(library.button('Open Salute, copy')).toBeHidden();
  await library.dialog.getByRole('switch', { name: 'Deleted' }).check();
  await library.card('Salute, copy').getByRole('button', { name: 'Restore' }).click();
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
  await importInto(library, page, libraryToText({ documents }));
  const cards = library.list.getByRole('listitem');
  const named = library.list.getByRole('button', { name: /^Open / });
  // The browser's database takes a hundred in its own time.
  await expect(cards.first()).toHaveAttribute('aria-setsize', /^[1-9]\d\d$/, { timeout: 30_000 });
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

test('a version is deleted alone, and comes back', async ({ dashboard, page }) => {
  const library = libraryOf(page);
  await captureGroup(dashboard, [1500]);
  await library.call('Greeting');
  await library.show();
  await library.more('Greeting');
  await library.write('Name of the version', 'First try');
  await expect(library.button('Go back to First try')).toBeVisible();
  await library.write('Name of the version', 'Second try');
  await expect(library.button('Go back to Second try')).toBeVisible();
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

test('what stands below the groups stays where it is when the first comes', async ({ dashboard, page }) => {
  const library = libraryOf(page);
  await expect(dashboard.frames).toHaveCount(0);
  await library.show();
  await expect(library.dialog).toContainText('No groups in the library yet');
  const before = await library.button('New group').boundingBox();
  const group = emptyGroup('First', 'us');
  await importInto(
    library,
    page,
    libraryToText({ documents: [{ id: 'first', updatedAtMs: 0, versions: [], group }] }),
  );
  await expect(library.card('First')).toBeVisible();
  expect(await library.button('New group').boundingBox()).toEqual(before);
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

test('the whole library moves into another browser as one file', async ({ dashboard, page, url }) => {
  const library = libraryOf(page);
  await captureGroup(dashboard, [1500, 1600]);
  await library.call('Travelling');
  await library.show();
  await poll(library.names).toContain('Travelling');
  const downloading = page.waitForEvent('download');
  await library.button('Export').click();
  const text = await (await downloading).text();

  await page.forget();
  await page.goto(url);
  await library.show();
  await expect(library.dialog).toContainText('Stored in this browser');
  await expect(library.dialog).toContainText('No groups in the library yet');
  await importInto(library, page, text.slice(0, text.length / 2));
  await expect(dashboard.notices).toContainText('Nothing was imported');
  await importInto(library, page, text);
  await library.open('Travelling');
  await page.reload();
  await expect(library.groupName).toHaveValue('Travelling');
  await expect(dashboard.frames).toHaveCount(2);
});
