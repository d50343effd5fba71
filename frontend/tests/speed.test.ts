// How fast a group turns each servo, beside what it can do: below the tracks, on request.

import * as e2e from '../../e2e/fixtures/timeline.ts';
import { expect, here, test } from './harness/test.ts';

const keepGroup = here(e2e.keepGroup);
const timelineOf = here(e2e.timelineOf);

test.beforeEach(async ({ page }) => {
  await keepGroup(page);
});

test('speeds and current are shown by a key, follow an edit, and are hidden again', async ({
  dashboard,
  page,
}) => {
  const { grid } = timelineOf(page);
  const speeds = page.getByRole('region', { name: 'Speed and current' });
  await expect(dashboard.frames).toHaveCount(3);
  await expect(speeds).toBeHidden();
  await grid.press('v');
  const servo = (name: string) => speeds.getByRole('listitem').filter({ hasText: name });
  await expect(servo('Gripper')).toContainText('36 of 257°/s');
  await expect(servo('Elbow')).toContainText('0 of 257°/s');
  await expect(servo('All together')).toContainText('up to 0.1 A');

  await dashboard.type(dashboard.frameTime(3), 60);
  await expect(servo('Gripper')).toContainText('300 of 257°/s');

  await dashboard.type(dashboard.field('Current of the supply, in amperes'), 0.4);
  await expect(servo('All together')).toContainText('0.5 of 0.4 A');
  await dashboard.button('Hide speed and current').click();
  await expect(speeds).toBeHidden();
});

test('staggered starts lower the peak of the current, as one step', async ({ dashboard, page }) => {
  await dashboard.button('Examples').click();
  await page.getByRole('list', { name: 'Examples' }).getByRole('button', { name: /^Bow/ }).click();
  const { grid } = timelineOf(page);
  await grid.press('v');
  await dashboard.button('Stagger').click();
  await expect(dashboard.notices).toContainText(
    /Each servo begins \d+ ms after the one before: [\d.]+ A, now [\d.]+ A\./,
  );
  await dashboard.button('Undo: stagger').click();
  await expect(dashboard.button('Undo: example Bow')).toBeEnabled();
});
