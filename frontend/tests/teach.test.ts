// Teaching by hand: an xArm whose released servos are turned.

import { lastTarget, ofKind } from '../../e2e/fixtures/bus.ts';
import { READY } from '../../e2e/fixtures/dashboard.ts';
import type { Page } from './harness/page.ts';
import { test as base, dashboardOf, expect, poll, type Dashboard } from './harness/test.ts';

const test = base.extend({ boardSettings: { board: 'xarm' } });

/** Steps a millisecond: the whole range in 0.7 s. */
const SOFT_LIMIT = 1000 / 700;

/** Of a slider under a mouse: its way is so much shorter than its box. */
const THUMB_PX = 18;

/** Chosen anew: nothing has been asked of it that tells where a servo is. */
async function connect(page: Page, url: string): Promise<Dashboard> {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await dashboard.button('Connect').click();
  await dashboard.button('Choose a port').click();
  await dashboard.takeFor('xArm').click();
  await expect(dashboard.link).toHaveText(READY);
  await expect(page.getByText('Move a servo or read positions first.').first()).toBeVisible();
  return dashboard;
}

test('the arm is posed by hand, captured while it is read, and holds at the end', async ({
  page,
  robot,
  url,
}) => {
  const dashboard = await connect(page, url);
  await dashboard.button('Teach').click();
  const warning = page.getByRole('alertdialog', { name: 'Teach by hand?' });
  await expect(warning).toContainText('the arm drops: hold it');
  await warning.getByRole('button', { name: 'Release and teach' }).click();
  await expect(dashboard.target(3)).toHaveValue('400');
  await expect(page.getByText('Teaching: turn the servos by hand')).toBeVisible();

  robot.turn(3, 620);
  await expect(dashboard.target(3)).toHaveValue('620');
  await dashboard.button('Capture frame').click();
  robot.turn(3, 300);
  await expect(dashboard.target(3)).toHaveValue('300');
  await dashboard.button('Capture frame').click();
  await expect(dashboard.frame(2)).toBeVisible();
  expect(ofKind(await robot.bus(), 'move')).toEqual([]);

  await dashboard.button('Hold and end teaching').click();
  await poll(async () => {
    const moves = ofKind(await robot.bus(), 'move');
    return moves.map(({ targets: [target], durationMs }) => [target?.servo, target?.position, durationMs]);
  }).toEqual([1, 2, 3, 4, 5, 6].map((servo) => [servo, servo === 3 ? 300 : 400, 1500]));
  await expect(dashboard.button('Teach')).toBeEnabled();
});

test('what was read is the pose, without teaching: on the body, in a frame, as a pose to go to', async ({
  page,
  robot,
  url,
}) => {
  const dashboard = await connect(page, url);
  await expect(dashboard.capture).toBeDisabled();
  await page.getByRole('radio', { name: 'Body' }).check();
  const unknown = page.getByText('Positions are unknown until each servo is moved once.').first();
  const drawn = () => page.evaluate(() => document.querySelector('[data-figure="estimated"]')?.outerHTML);
  await expect(unknown).toBeVisible();
  await dashboard.button('Release').click();
  await page.getByRole('button', { name: 'Release every servo' }).click();
  robot.turn(3, 620);
  await dashboard.button('Read positions').click();
  await expect(unknown).toBeHidden();
  await expect(dashboard.capture).toBeEnabled();
  const bent = await drawn();
  robot.turn(3, 200);
  await dashboard.button('Read positions').click();
  await poll(drawn).not.toBe(bent);
  robot.turn(3, 620);
  await dashboard.button('Read positions').click();
  await poll(drawn).toBe(bent);
  await dashboard.capture.click();
  await expect(dashboard.frame(1)).toHaveAccessibleName(/moves servos 1, 2, 3, 4, 5, and 6$/);

  await page.getByRole('radio', { name: 'Poses' }).check();
  await dashboard.button('Capture pose').click();
  expect(ofKind(await robot.bus(), 'move'), 'until here nothing was moved').toEqual([]);
  robot.turn(3, 300);
  await dashboard.button(/^Go to /).click();
  await poll(() => lastTarget(robot.bus, 3)).toBe(620);
  expect(ofKind(await robot.bus(), 'move')[0]?.durationMs).toBeGreaterThanOrEqual(1500);
});

test('a thumb stands where its servo was read, and dragged by 2 px it takes the servo along no faster than the soft limit', async ({
  page,
  robot,
  url,
}) => {
  const dashboard = await connect(page, url);
  await dashboard.button('Read positions').click();
  await expect(dashboard.slider(3)).toHaveValue('400');
  const { x, y, width, height } = await dashboard.slider(3).boundingBox();
  const [least, most] = await dashboard
    .slider(3)
    .evaluate((slider) => [Number(slider.getAttribute('min')), Number(slider.getAttribute('max'))]);
  const thumbX = x + THUMB_PX / 2 + ((width - THUMB_PX) * (400 - least)) / (most - least);
  await page.mouse.move(thumbX, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(thumbX + 2, y + height / 2);
  await page.mouse.up();
  await poll(() => lastTarget(robot.bus, 3)).toBeGreaterThan(400);
  const moves = ofKind(await robot.bus(), 'move');
  expect(moves.at(-1)?.targets[0]?.position).toBeLessThan(430);
  for (const { targets, durationMs } of moves)
    expect(((targets[0]?.position ?? NaN) - 400) / durationMs).toBeLessThan(SOFT_LIMIT);
});

test('on a phone it is said in sight, wherever one has scrolled to', async ({ page, dashboard }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.getByRole('tab', { name: 'Drive' }).click();
  await dashboard.button('Teach').click();
  await page.getByRole('button', { name: 'Release and teach' }).click();
  await expect(dashboard.status).toHaveText('Teaching: keep holding');
  await expect(dashboard.status).toBeInViewport({ ratio: 1 });
  await dashboard.button('Hold and end teaching').click();
  await expect(dashboard.status).not.toContainText('Teaching');
});

test('Esc ends it and moves nothing', async ({ page, robot, dashboard }) => {
  await dashboard.button('Teach').click();
  await page.getByRole('button', { name: 'Release and teach' }).click();
  await expect(dashboard.target(1)).toHaveValue('400');
  await page.keyboard.press('Escape');
  await expect(dashboard.resume).toBeVisible();
  // Behind the message that all is stopped.
  await expect(page.getByText('Teaching has ended.')).toHaveCount(1);
  expect(ofKind(await robot.bus(), 'move')).toEqual([]);
});
