// What a visitor meets: the robot in the middle of Drive, few controls, and workspaces whose sizes are remembered.

import { ofKind } from '../../e2e/fixtures/bus.ts';
import { dashboardOf, expect, poll, test } from './harness/test.ts';
import { advance } from './harness/time.ts';
import type { Page } from './harness/page.ts';

// How long fetching it takes is for a server to say.
await import('../src/app/welcome.ts');

const workspace = (page: Page, name: string) => page.getByRole('radio', { name, exact: true });

/** What can be pressed, set or typed in, in sight; a choice counts once, and so does the row of a servo. */
function controlsInSight(): number {
  const all = [...document.querySelectorAll<HTMLElement>('button, input, select, textarea, a[href]')];
  const seen = all.filter((control) => {
    const { left, top, right, bottom } = control.getBoundingClientRect();
    const isInWindow = right > 0 && bottom > 0 && left < innerWidth && top < innerHeight;
    return isInWindow && control.checkVisibility({ visibilityProperty: true, opacityProperty: true });
  });
  return new Set(seen.map((control) => control.closest('fieldset, li') ?? control)).size;
}

test.describe('in Drive', () => {
  test.override({ workspace: 'live', viewport: { width: 1280, height: 720 } });

  test('a first visitor sees the robot large, its sliders, and no more than 25 controls', async ({
    page,
    url,
  }) => {
    const dashboard = dashboardOf(page);
    await page.goto(url);
    await expect(dashboard.link).toHaveText(/Ready\s*Simulated/);
    expect(await page.evaluate(controlsInSight)).toBeLessThanOrEqual(25);
    const { width, height } = await page.getByRole('region', { name: 'Arm' }).boundingBox();
    expect((width * height) / (1280 * 720)).toBeGreaterThan(0.4);
    for (const servo of [1, 6]) await expect(dashboard.slider(servo)).toBeInViewport({ ratio: 1 });
    await expect(page.getByRole('region', { name: 'Action group' })).toHaveCount(0);
  });

  test('one press shows a motion, and the way to how it is made', async ({ page, url }) => {
    const dashboard = dashboardOf(page);
    await page.goto(url);
    await expect(dashboard.link).toHaveText(/Ready\s*Simulated/);
    await advance(4000);
    await dashboard.button('Wave').click();
    await expect(dashboard.status).toContainText('Playing');
    await dashboard.button('See how it is made').click();
    await expect(dashboard.frame(1)).toBeVisible();
    await expect(page.getByRole('textbox', { name: 'Name of the group' })).toHaveValue('Wave');
  });

  test('poses open below the robot and close, and undo is theirs meanwhile', async ({ dashboard, page }) => {
    await dashboard.type(dashboard.target(6), 1800);
    await expect(dashboard.estimate(6)).toHaveText('≈ 1800');
    const poses = dashboard.button('Poses');
    await poses.click();
    await dashboard.button('Capture pose').click();
    const list = page.getByRole('list', { name: 'Poses' }).getByRole('listitem');
    await expect(list).toHaveCount(1);
    await page.keyboard.press('Control+z');
    await expect(list).toHaveCount(0);
    await poses.click();
    await expect(dashboard.button('Capture pose')).toHaveCount(0);
  });

  test('a splitter is moved by keys and by the mouse, remembered, and put back', async ({
    dashboard,
    page,
  }) => {
    const splitter = page.getByRole('separator', { name: 'Width of the sliders' });
    const width = async (): Promise<number> =>
      (await page.getByRole('region', { name: 'Servos' }).boundingBox()).width;
    const before = await width();
    await splitter.focus();
    await page.keyboard.press('ArrowLeft');
    await poll(width).toBe(before + 16);
    const { x, y, height } = await splitter.boundingBox();
    await page.mouse.move(x + 4, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x - 60, y + height / 2);
    await page.mouse.up();
    await poll(width).toBe(before + 80);
    await page.reload();
    await expect(dashboard.slider(1)).toBeVisible();
    await poll(width).toBe(before + 80);
    await splitter.dblclick();
    await poll(width).toBe(before);
  });
});

test('each workspace has its own work, and a slot is one press from the timeline', async ({
  dashboard,
  page,
}) => {
  await expect(page.getByRole('region', { name: 'Action group' })).toBeVisible();
  await workspace(page, 'Board').check();
  await expect(dashboard.log).toBeVisible();
  await expect(dashboard.battery).toContainText('7.50 V');
  await expect(dashboard.slot).toBeVisible();
  await workspace(page, 'Drive').check();
  await expect(page.getByRole('region', { name: 'Arm' })).toBeVisible();
  await page.reload();
  await expect(workspace(page, 'Drive')).toBeChecked();
});

test('the timeline has the full width, with the robot above it, until the sliders are wanted', async ({
  dashboard,
  page,
}) => {
  await page.setViewportSize({ width: 1280, height: 720 });
  const rows = page.getByRole('region', { name: 'Timeline' });
  const width = async (): Promise<number> => (await rows.boundingBox()).width;
  await expect(dashboard.slider(1)).toBeVisible();
  await dashboard.button('Use the full width').click();
  await poll(width).toBeGreaterThan(1200);
  await expect(dashboard.slider(1)).toHaveCount(0);
  const robot = page.getByRole('region', { name: 'Arm' });
  const height = async (): Promise<number> => Math.round((await robot.boundingBox()).height);
  const before = await height();
  await page.getByRole('separator', { name: 'Height of the robot' }).focus();
  await page.keyboard.press('ArrowDown');
  await poll(height).toBe(before + 16);
  await page.reload();
  await poll(height).toBe(before + 16);
  await dashboard.button('Show the sliders').click();
  await expect(dashboard.slider(1)).toBeVisible();
});

test('what plays a group stands above its ruler, from the first frame on', async ({ dashboard, page }) => {
  const player = page.getByRole('group', { name: 'Play the group' });
  await expect(dashboard.capture).toBeVisible();
  await expect(player).toHaveCount(0);
  await dashboard.type(dashboard.target(6), 1800);
  await expect(dashboard.estimate(6)).toHaveText('≈ 1800');
  await dashboard.capture.click();
  const bottomOf = async (part: typeof player): Promise<number> => {
    const { y, height } = await part.boundingBox();
    return y + height;
  };
  const { y } = await page.getByRole('region', { name: 'Timeline' }).boundingBox();
  expect(await bottomOf(player)).toBeLessThanOrEqual(y);
});

test('the cards of frames fold away, and the timeline has their room', async ({ dashboard, page }) => {
  await dashboard.type(dashboard.target(6), 1800);
  await expect(dashboard.estimate(6)).toHaveText('≈ 1800');
  await dashboard.capture.click();
  const rows = page.getByRole('region', { name: 'Timeline' });
  const height = async (): Promise<number> => (await rows.boundingBox()).height;
  const before = await height();
  await dashboard.button('Hide the frame cards').click();
  await expect(dashboard.frame(1)).toHaveCount(0);
  await poll(height).toBeGreaterThan(before + 60);
  await page.reload();
  await dashboard.button('Show the frame cards').click();
  await expect(dashboard.frame(1)).toBeVisible();
});

test('on a later visit the simulated robot stands up, and then moves only when it is moved', async ({
  page,
  url,
}) => {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await expect(dashboard.estimate(4)).toHaveText('≈ 2050');
  await advance(20_000);
  await expect(dashboard.estimate(4)).toHaveText('≈ 2050');
  await dashboard.type(dashboard.target(4), 1800);
  await expect(dashboard.estimate(4)).toHaveText('≈ 1800');
  await page.reload();
  await expect(dashboard.estimate(4)).toHaveText('≈ 2050');
});

test.describe('on the first visit', () => {
  test.override({ workspace: 'live' });

  test('the simulated robot breathes until a key is pressed', async ({ page, url }) => {
    await page.addInitScript(() => localStorage.removeItem('servodeck.visited'));
    const dashboard = dashboardOf(page);
    await page.goto(url);
    await expect(dashboard.link).toHaveText(/Ready\s*Simulated/);
    const leaves = new Set<string>();
    await expect(dashboard.bar).toContainText('7.50 V');
    for (let second = 0; second < 20; second += 1) {
      await advance(1000);
      leaves.add(await dashboard.target(4).inputValue());
    }
    expect(leaves.size).toBeGreaterThan(1);
    await page.keyboard.press('Tab');
    await advance(3000);
    const rests = await dashboard.target(4).inputValue();
    await advance(8000);
    expect(await dashboard.target(4).inputValue()).toBe(rests);
  });

  test('a connected robot does not move by itself', async ({ page, robot }) => {
    await page.addInitScript(() => localStorage.removeItem('servodeck.visited'));
    await robot.open();
    await expect(dashboardOf(page).link).toHaveText(/^Ready/);
    await advance(10_000);
    expect(ofKind(await robot.bus(), 'move')).toEqual([]);
  });
});
