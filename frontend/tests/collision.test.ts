// A group that may make the robot touch itself: marked on the ruler, listed, named where it is played, and played all the same.

import { ofKind } from '../../e2e/fixtures/bus.ts';
import * as e2e from '../../e2e/fixtures/timeline.ts';
import type { Page } from './harness/page.ts';
import { expect, here, poll, test } from './harness/test.ts';

const timelineOf = here(e2e.timelineOf);

const RULER_Y = 11;
const HOME = [1500, 1500, 1500, 1500, 1500, 1500];
/** Shoulder forward, elbow and wrist folded back: the gripper comes to the base and below the floor. */
const FOLDED = [1500, 1500, 2500, 2500, 2300, 1500];

async function storeGroup(page: Page, ...poses: readonly (readonly number[])[]): Promise<void> {
  const frames = poses.map((positions, index) => ({
    ...{ id: index + 1, durationMs: index === 0 ? 500 : 1500, easing: 'linear', note: '', colour: null },
    targets: positions.map((position, servo) => ({ servo: servo + 1, position })),
  }));
  const about = { name: 'Fold', unit: 'us', robot: '', tags: [], slot: null, times: 1 };
  const content = { ...about, frames, markers: [], nextId: poses.length + 1 };
  const file = JSON.stringify({ format: 'servodeck-group', version: 1, content });
  await page.addInitScript((text) => localStorage.setItem('servodeck.group', text), file);
}

test.describe('a group that folds the arm onto its base', () => {
  test.beforeEach(async ({ page }) => {
    await storeGroup(page, HOME, FOLDED, HOME);
  });

  test('has its places listed, each leading there, and named at Play and at Download', async ({
    dashboard,
    page,
  }) => {
    const list = page.getByRole('list', { name: 'Places where it may touch' });
    const place = list.getByRole('button', {
      name: /^Gripper may touch the floor, 1\.\d\d–\d\.\d\d s \(estimate\)$/,
    });
    await expect(place).toBeVisible();
    await expect(list.getByRole('button', { name: /may touch the base/ }).first()).toBeVisible();
    const summary = /^May touch itself or the floor at 1 place \(estimate\)$/;
    await expect(page.getByRole('group', { name: 'Play the group' }).getByRole('status')).toHaveText(summary);
    await expect(dashboard.board).toContainText('May touch');
    await place.click();
    await expect(dashboard.button(/^Play from 1\.\d s/)).toBeVisible();
  });

  test('has a mark on the ruler that says what it is about', async ({ dashboard, page }) => {
    await expect(page.getByRole('list', { name: 'Places where it may touch' })).toBeVisible();
    await expect(dashboard.frames).toHaveCount(3);
    const timeline = timelineOf(page);
    const folded = await timeline.middleOf(timeline.key('Elbow, 2.00 s, 2500 µs, linear'));
    const { y: top } = await timeline.grid.boundingBox();
    await page.mouse.move(folded.x, top + RULER_Y);
    await expect(timeline.region).toContainText(/may touch .*, 1\.\d\d–\d\.\d\d s \(estimate\)/);
  });

  test('is played all the same', async ({ dashboard, page, robot }) => {
    await expect(page.getByRole('list', { name: 'Places where it may touch' })).toBeVisible();
    const before = ofKind(await robot.bus(), 'move').length;
    await dashboard.button(/^Play/).click();
    await poll(async () => ofKind(await robot.bus(), 'move').length).toBeGreaterThan(before);
  });
});
