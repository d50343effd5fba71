// A group made only of blocks has the controls of any other, and what its keys begin can be seen and ended.

import { ofKind } from '../../e2e/fixtures/bus.ts';
import * as e2e from '../../e2e/fixtures/timeline.ts';
import { filesDialogOf } from './filesDialog.ts';
import { expect, here, poll, test } from './harness/test.ts';
import { advance } from './harness/time.ts';

const keepBlock = here(e2e.keepBlock);
const timelineOf = here(e2e.timelineOf);

test.describe('a group made only of blocks', () => {
  test.beforeEach(async ({ page }) => {
    await keepBlock(page, [1000, 1200, 1400]);
  });

  test('is played, looked at and run from its buttons and by its keys', async ({
    dashboard,
    page,
    robot,
  }) => {
    const { grid } = timelineOf(page);
    const player = page.getByRole('group', { name: 'Play the group' });
    await expect(dashboard.frames).toHaveCount(0);
    await expect(page.getByText('0 frames, 1.5 sec')).toBeVisible();
    await expect(dashboard.button('Play')).toBeEnabled();
    await expect(dashboard.button('Download')).toBeEnabled();

    await grid.press('Shift+Space');
    await expect(player.getByRole('button', { name: 'Pause' })).toHaveCount(1);
    await player.getByRole('button', { name: 'Pause' }).click();
    await expect(dashboard.button('Preview')).toBeVisible();
    expect(ofKind(await robot.bus(), 'move')).toEqual([]);

    await dashboard.button('Frame back').click();
    await grid.press(' ');
    await poll(async () => ofKind(await robot.bus(), 'move').length).toBeGreaterThan(0);
    await expect(player.getByRole('button', { name: 'Pause' })).toBeEnabled();
    await player.getByRole('button', { name: 'Pause' }).click();
    await advance(3000);
    await expect(dashboard.status).toHaveText('Idle');

    await dashboard.button('Run on board').click();
    await poll(async () => ofKind(await robot.bus(), 'run').length).toBe(1);
    expect(ofKind(await robot.bus(), 'download').length).toBeGreaterThan(0);
  });

  test('is saved as a file and taken from one', async ({ dashboard }) => {
    const files = filesDialogOf(dashboard);
    const { name, content } = await files.save('Servodeck');
    expect(name).toBe('Wave.json');
    await files.open({ name, content });
    await expect(files.file('Wave.json')).toContainText('1.5 sec');
  });
});

test.describe('an empty group', () => {
  test('is not looked at: the key says why', async ({ dashboard, page }) => {
    const { grid } = timelineOf(page);
    await grid.press('Shift+Space');
    await expect(dashboard.notices).toContainText('Capture a frame first.');
    await expect(page.getByRole('group', { name: 'Play the group' })).toHaveCount(0);
  });
});
