// The page of buttons: made, used by finger and key, never while stopped; the kiosk that only a long press leaves.

import { lastTarget, ofKind } from '../../e2e/fixtures/bus.ts';
import * as notes from '../../e2e/fixtures/notes.ts';
import type { Page } from './harness/page.ts';
import type { Robot } from './harness/robot.ts';
import { expect, here, poll, test, type Dashboard } from './harness/test.ts';
import { advance } from './harness/time.ts';

const { noteTexts } = here(notes);

const buttonOf = (page: Page, name: string) =>
  page.getByRole('list', { name: 'Buttons' }).getByRole('button', { name: new RegExp(`^${name}`) });

/** A pose of servo 1 as a button with the key G, on the page of buttons. */
async function makeButton(dashboard: Dashboard, page: Page): Promise<void> {
  await page.getByRole('radio', { name: 'Poses' }).check();
  await dashboard.type(dashboard.target(1), 1800);
  await dashboard.button('Capture pose').click();
  await dashboard.type(dashboard.target(1), 1500);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1500');
  await dashboard.button('Make a button').click();
  await page.getByRole('radio', { name: 'Buttons' }).check();
  await page.getByRole('switch', { name: 'Edit buttons' }).check();
  await buttonOf(page, 'Pose 1').click();
  await dashboard.button('Set a key').click();
  await page.keyboard.press('g');
  await expect(buttonOf(page, 'Pose 1')).toHaveAccessibleName('Pose 1, key G');
}

const leaveEditing = (page: Page) => page.getByRole('switch', { name: 'Edit buttons' }).uncheck();

/** What buttons ask for; STOP holds the robot by moves as short as the board takes. */
const slowMoves = async ({ bus }: Robot) =>
  ofKind(await bus(), 'move').filter(({ durationMs }) => durationMs >= 1500);

test('a sequence is made, runs by a press and by its key, and STOP ends it for good', async ({
  dashboard,
  page,
  robot,
}) => {
  await makeButton(dashboard, page);
  await dashboard.button('Wait').click();
  await dashboard.button('Pose').click();
  await page.getByRole('combobox', { name: 'Pose of step 3' }).selectOption('Home');
  await page.getByRole('radio', { name: 'Plum' }).check();
  await dashboard.field('Name of the button').fill('Greet');
  await dashboard.field('Name of the button').press('Enter');
  // Typed into a field the key is a letter.
  await dashboard.field('Name of the button').fill('Great');
  await dashboard.field('Name of the button').press('Enter');
  await leaveEditing(page);
  expect(await lastTarget(robot.bus, 1)).toBe(1500);

  const said = await noteTexts(buttonOf(page, 'Great'));
  await buttonOf(page, 'Great').click();
  await poll(() => lastTarget(robot.bus, 1)).toBe(1800);
  for (const step of ['Step 1 of 3', 'Step 2 of 3'])
    await poll(said).toContainEqual(expect.stringContaining(step));
  await poll(() => lastTarget(robot.bus, 6)).toBe(1500);
  await expect(buttonOf(page, 'Great')).toHaveAttribute('aria-pressed', 'false');

  await page.keyboard.press('g');
  await poll(() => lastTarget(robot.bus, 1)).toBe(1800);
  await page.keyboard.press('Escape');
  await expect(dashboard.resume).toBeVisible();
  await expect(buttonOf(page, 'Great')).toHaveAttribute('aria-pressed', 'false');
  const asked = (await slowMoves(robot)).length;
  await page.keyboard.press('g');
  await expect(dashboard.notices).toContainText('Stopped. Resume to move.');
  await dashboard.resume.click();
  await expect(dashboard.resume).toBeHidden();
  expect(await slowMoves(robot)).toHaveLength(asked);
});

test('the kiosk shows only buttons and Stop, also after a reload, until a long press', async ({
  dashboard,
  page,
  robot,
}) => {
  await makeButton(dashboard, page);
  await leaveEditing(page);
  await dashboard.button('Kiosk').click();
  await page.reload();
  await expect(dashboard.status).toHaveText('Idle');
  await expect(buttonOf(page, 'Pose 1')).toBeVisible();
  const offered = page.getByRole('button').filter({ visible: true });
  await expect(offered).toHaveText([/^Stop/, /^Pose 1/, /^Hold for 2 seconds/]);
  await expect(page.getByRole('radio')).toHaveCount(0);

  await page.keyboard.press('g');
  await poll(() => lastTarget(robot.bus, 1)).toBe(1800);
  await dashboard.stop.click();
  await expect(dashboard.resume).toBeVisible();

  const leave = dashboard.button('Hold for 2 seconds to leave');
  await leave.click();
  await expect(leave).toBeVisible();
  await leave.hover();
  await page.mouse.down();
  await expect(page.getByRole('switch', { name: 'Edit buttons' })).toBeVisible();
  await page.mouse.up();
});

test.describe('with a finger', () => {
  test.override({ screen: { hasTouch: true }, viewport: { width: 390, height: 844 } });

  test('the kiosk is left by one that stays, not by one that has gone elsewhere', async ({
    dashboard,
    page,
  }) => {
    await page.getByRole('tab', { name: 'Buttons' }).tap();
    await dashboard.button('Kiosk').tap();
    await page.reload();
    const leave = dashboard.button('Hold for 2 seconds to leave');
    const box = await leave.boundingBox();
    const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    const { touch } = page.touchscreen;
    await touch('touchStart', middle);
    for (let step = 1; step <= 30; step += 1) {
      await touch('touchMove', { x: middle.x + (step % 2), y: middle.y - 10 * step });
      await advance(84);
    }
    await touch('touchEnd');
    await expect(leave).toBeVisible();
    await touch('touchStart', middle);
    await expect(leave).toBeHidden();
    await touch('touchEnd');
  });
});

test('a button moves to another place by key, and is deleted, and each is undone', async ({
  dashboard,
  page,
}) => {
  await makeButton(dashboard, page);
  await dashboard.button('Add button').click();
  const names = () =>
    page
      .getByRole('list', { name: 'Buttons' })
      .getByRole('button')
      .evaluateAll((all) => all.map((one) => one.getAttribute('aria-label')).filter((name) => name !== null));
  await poll(names).toEqual(['Pose 1, key G', 'Button 2']);
  await buttonOf(page, 'Button 2').press('Alt+ArrowLeft');
  await poll(names).toEqual(['Button 2', 'Pose 1, key G']);
  await buttonOf(page, 'Pose 1').press('Delete');
  await poll(names).toEqual(['Button 2']);
  await dashboard.button('Undo: delete Pose 1').click();
  await page.keyboard.press('Control+z');
  await poll(names).toEqual(['Pose 1, key G', 'Button 2']);
});

test('a key that no button may have is refused with the reason', async ({ dashboard, page }) => {
  await makeButton(dashboard, page);
  await dashboard.button('G').click();
  await page.keyboard.press('Control+c');
  await expect(dashboard.notices).toContainText('Use a letter, a digit or a symbol');
  await page.keyboard.press('Space');
  await expect(buttonOf(page, 'Pose 1')).toHaveAccessibleName('Pose 1, key G');
  await page.keyboard.press('h');
  await expect(buttonOf(page, 'Pose 1')).toHaveAccessibleName('Pose 1, key H');
});

test('a key that is given to another button is said to have left the first', async ({ dashboard, page }) => {
  await makeButton(dashboard, page);
  await dashboard.button('Add button').click();
  await dashboard.button('Set a key').click();
  await page.keyboard.press('g');
  await expect(buttonOf(page, 'Button 2')).toHaveAccessibleName('Button 2, key G');
  await expect(buttonOf(page, 'Pose 1')).toHaveAccessibleName('Pose 1');
  await expect(dashboard.notices).toContainText('G was the key of Pose 1, which now has none.');
});
