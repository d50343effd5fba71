// Keys made into a block above the rows: moved, repeated, kept over a visit, and taken apart again.

import * as e2e from '../../e2e/fixtures/timeline.ts';
import { expect, here, test } from './harness/test.ts';

const keepGroup = here(e2e.keepGroup);
const timelineOf = here(e2e.timelineOf);

test.beforeEach(async ({ page }) => {
  await keepGroup(page, [1000, 1200, 1000]);
});

test('a block is made of the selected keys, moved, repeated and unpacked; undo takes each step back', async ({
  dashboard,
  page,
}) => {
  const timeline = timelineOf(page);
  const row = page.getByRole('group', { name: 'Blocks' });
  const bar = (about: string) => row.getByRole('button', { name: `Block 1, from ${about}`, exact: true });
  await expect(row).toBeHidden();
  await timeline.click('Gripper, 0.50 s, 1000 µs, linear');
  await timeline.click('Gripper, 1.50 s, 1000 µs, linear', ['Shift']);
  await timeline.grid.press('b');
  await expect(bar('0.50 s to 1.50 s, once')).toBeVisible();
  await expect(timeline.grid.getByRole('gridcell', { name: /^Gripper, \d/ })).toHaveCount(0);

  await bar('0.50 s to 1.50 s, once').press('Shift+ArrowRight');
  await expect(bar('0.70 s to 1.70 s, once')).toBeVisible();
  await dashboard.button('Undo: move block').click();

  await bar('0.50 s to 1.50 s, once').press('Enter');
  const settings = page.getByRole('group', { name: 'Block Block 1', exact: true });
  await settings.getByLabel('Times').fill('3');
  await settings.getByLabel('Times').press('Enter');
  await expect(bar('0.50 s to 3.50 s, 3 times')).toBeVisible();
  await expect(page.getByText('3 frames, 3.5 sec')).toBeVisible();

  await page.reload();
  await bar('0.50 s to 3.50 s, 3 times').press('Enter');
  await settings.getByRole('button', { name: 'Unpack' }).click();
  await expect(row).toBeHidden();
  await expect(timeline.key('Gripper, 3.00 s, 1200 µs, linear')).toBeVisible();
  await expect(page.getByText(/frames, 3\.5 sec/)).toBeVisible();
  await dashboard.button('Undo: unpack block').click();
  await expect(bar('0.50 s to 3.50 s, 3 times')).toBeVisible();
});

test('a block is dragged by hand, its edge repeats it, and Escape cancels', async ({ dashboard, page }) => {
  const timeline = timelineOf(page);
  const row = page.getByRole('group', { name: 'Blocks' });
  const bar = row.getByRole('button', { name: /^Block 1/ });
  await timeline.click('Gripper, 0.50 s, 1000 µs, linear');
  await timeline.click('Gripper, 1.50 s, 1000 µs, linear', ['Shift']);
  await timeline.grid.press('b');
  const box = await bar.boundingBox();
  const y = box.y + box.height / 2;
  await page.mouse.move(box.x + 20, y);
  await page.mouse.down();
  await page.mouse.move(box.x + 80, y, { steps: 8 });
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await expect(bar).toHaveAccessibleName('Block 1, from 0.50 s to 1.50 s, once');
  await page.mouse.move(box.x + box.width - 3, y);
  await page.mouse.down();
  await page.mouse.move(box.x + 1.9 * box.width, y, { steps: 8 });
  await page.mouse.up();
  await expect(bar).toHaveAccessibleName('Block 1, from 0.50 s to 2.50 s, 2 times');
  await dashboard.button('Undo: change block').click();
  await page.mouse.move(box.x + 20, y);
  await page.mouse.down();
  await page.mouse.move(box.x + 20 + box.width / 2, y, { steps: 8 });
  await page.mouse.up();
  await expect(bar).toHaveAccessibleName(/^Block 1, from (0\.9\d|1\.0\d) s/);
});
