// The list of all actions: every action with its keys, searched, and done from there.

import { FRAME_ACTIONS, FRAME_KEYS } from '../src/features/animate/frames/frameActions.ts';
import { PLAY_ACTIONS } from '../src/features/animate/play/playActions.ts';
import { TIMELINE_ACTIONS, TIMELINE_KEYS } from '../src/features/animate/timeline/timelineActions.ts';
import { PAGE_ACTIONS } from '../src/app/pageActions.ts';
import { chordText } from '../src/ui/Hint.tsx';
import type { Page } from './harness/page.ts';
import { dashboardOf, expect, test } from './harness/test.ts';

const listIn = (page: Page) => {
  const dialog = page.getByRole('dialog', { name: 'Actions and keys' });
  return {
    dialog,
    search: dialog.getByRole('searchbox', { name: 'Search actions' }),
    group: (name: string) => dialog.getByRole('group', { name, exact: true }),
    action: (name: string | RegExp) => dialog.getByRole('menuitem', { name }),
  };
};

async function opened(page: Page, url: string) {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await expect(dashboard.link).toHaveText(/Ready/);
  return { dashboard, list: listIn(page) };
}

test('it has every action that has a key, with its keys', async ({ page, url }) => {
  const { list } = await opened(page, url);
  await page.keyboard.press('?');
  await expect(list.search).toBeFocused();
  for (const [name, actions] of [
    ['Everywhere', PAGE_ACTIONS],
    ['Timeline', [...PLAY_ACTIONS, ...Object.values(TIMELINE_ACTIONS), ...TIMELINE_KEYS]],
    ['Frames', [...Object.values(FRAME_ACTIONS), ...FRAME_KEYS]],
  ] as const) {
    const text = await list
      .group(name)
      .evaluate((group) => [...group.querySelectorAll('kbd')].map((key) => key.textContent));
    const wanted = actions.flatMap(({ keys }) => keys.map(chordText));
    expect(wanted.filter((key) => !text.includes(key))).toEqual([]);
  }
});

test('an action is searched and done by keyboard, and the field that it opens has the focus', async ({
  page,
  url,
}) => {
  const { dashboard, list } = await opened(page, url);
  await dashboard.capture.click();
  await page.keyboard.press('Control+k');
  await page.keyboard.type('marker');
  await expect(list.action('Next marker')).toBeVisible();
  await expect(list.action('Undo')).toBeHidden();
  await page.keyboard.press('Enter');
  await expect(list.dialog).toBeHidden();
  await expect(page.getByRole('textbox', { name: /marker/i })).toBeFocused();
});

test('what has no key is in it too: easings and colours, running on the board, the appearance', async ({
  page,
  url,
}) => {
  const { dashboard, list } = await opened(page, url);
  await dashboard.capture.click();
  await page.keyboard.press('Control+k');
  for (const name of ['Easing: linear', 'Colour: Plum', 'Run on board'])
    await expect(list.action(name)).toBeVisible();
  await list.action(/^Appearance/).click();
  await expect(dashboard.bar.getByRole('button', { name: /^Appearance: (Light|Dark)/ })).toBeVisible();
});

test('what cannot be done now stays in the list and says why', async ({ page, url }) => {
  const { dashboard, list } = await opened(page, url);
  await dashboard.bar.getByRole('button', { name: 'Actions and keys' }).click();
  await expect(list.action(/^Reverse/)).toBeDisabled();
  await expect(list.action(/^Reverse/)).toHaveAccessibleDescription('Select keys first.');
});

test('Escape closes it and stops the robot', async ({ page, url }) => {
  const { dashboard, list } = await opened(page, url);
  await page.keyboard.press('Control+k');
  await expect(list.search).toBeFocused();
  await page.keyboard.press('Escape');
  await expect(dashboard.status).toContainText('Stop');
});
