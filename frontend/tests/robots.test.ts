// One's own robot: taken from the ready ones, described, calibrated, saved to a file and read from one. Its limits hold
// wherever a servo can be moved.

import * as robotDialog from '../../e2e/fixtures/robotDialog.ts';
import { lastTarget, ofKind } from '../../e2e/fixtures/bus.ts';
import { expect, here, poll, test } from './harness/test.ts';
import { advance } from './harness/time.ts';

const { robotDialogOf } = here(robotDialog);

test('a servo is calibrated from nothing, and what was set holds everywhere', async ({
  dashboard,
  robot,
}) => {
  const robots = robotDialogOf(dashboard);
  await robots.opener.click();
  await robots.button('Add Arm, 6 servos').click();
  await expect(robots.button('Calibrate')).toBeFocused();
  await expect(robots.button('Calibrate')).toBeInViewport();
  await robots.button('Calibrate').click();
  expect(ofKind(await robot.bus(), 'move')).toEqual([]);

  await robots.button('Go slowly to the middle').click();
  await poll(() => lastTarget(robot.bus, 1)).toBe(1500);
  expect(ofKind(await robot.bus(), 'move')[0]?.durationMs).toBeGreaterThanOrEqual(1500);
  await expect(robots.dialog.getByText('≈ 1500')).toBeVisible();

  await robots.jogUntil('lower', () =>
    poll(async () => (await lastTarget(robot.bus, 1)) ?? 9999).toBeLessThan(1420),
  );
  const lowest = await settledAt(robots);
  await robots.button('Set lowest here').click();
  await robots.button('Undo: lowest of Gripper').click();
  await expect(robots.button('Lowest')).toHaveAttribute('aria-current', 'step');
  await robots.button('Set lowest here').click();
  await robots.jogUntil('higher', () =>
    poll(async () => (await lastTarget(robot.bus, 1)) ?? 0).toBeGreaterThan(1550),
  );
  const highest = await settledAt(robots);
  await robots.button('Set highest here').click();
  await robots.jog('lower').press('Enter');
  await settledAt(robots);
  await robots.button('Set home here').click();

  await robots.button('Turn a little').click();
  await robots.button('No, the other way').click();
  // How far the servo went depends on the computer: there is a trim for it, or there is none.
  await robots.button(/^(Leave it as it is|Continue)$/).click();
  await expect(robots.button('Gripper, 5 of 5 steps done')).toBeVisible();
  await robots.button('Close').click();

  await dashboard.type(dashboard.target(1), lowest - 20);
  await expect(dashboard.notices).toContainText(
    `Gripper: ${lowest - 20} is out of range; it takes ${lowest} to ${highest}.`,
  );
  await dashboard.type(dashboard.target(1), lowest);
  await poll(() => lastTarget(robot.bus, 1)).toBe(lowest);
});

test('a double press answers one question of the calibration, not the next one too', async ({
  dashboard,
  page,
}) => {
  const robots = robotDialogOf(dashboard);
  await robots.opener.click();
  await robots.button('Calibrate').click();
  await robots.button('Go slowly to the middle').click();
  await expect(robots.dialog.getByText('≈ 1500')).toBeVisible();
  await robots.button(/^Keep 500/).click();
  await robots.jogUntil('higher', () => poll(() => settledAt(robots)).toBeGreaterThan(1550));
  await settledAt(robots);
  await robots.button('Set highest here').dblclick();
  await expect(robots.button('Home')).toHaveAttribute('aria-current', 'step');
  await expect(robots.button('Highest, done')).toBeVisible();
  await robots.button('Set home here').focus();
  await page.keyboard.press('Enter');
  await page.keyboard.press('Enter');
  await expect(robots.button('Home, done')).toBeVisible();
  await expect(robots.button('Direction')).toHaveAttribute('aria-current', 'step');
  await expect(robots.button('Turn a little')).toBeVisible();
});

/** Where the servo was sent to, once the button that was held is let go. */
async function settledAt({ now }: ReturnType<typeof robotDialogOf>): Promise<number> {
  let before = NaN;
  for (;;) {
    const at = Number.parseInt(await now.textContent(), 10);
    if (at === before) return at;
    before = at;
    await advance(250);
  }
}

test('STOP ends a jogged servo, and the calibration waits for Resume', async ({ dashboard, robot, page }) => {
  const robots = robotDialogOf(dashboard);
  await dashboard.type(dashboard.target(1), 1500);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1500');
  await robots.opener.click();
  await robots.button('Calibrate').click();
  await robots.jog('higher').focus();
  await page.keyboard.down(' ');
  await poll(async () => (await lastTarget(robot.bus, 1)) ?? 0).toBeGreaterThan(1540);
  await dashboard.stop.click();
  await expect(robots.button('Resume')).toBeVisible();
  const moves = ofKind(await robot.bus(), 'move').length;
  await page.keyboard.up(' ');
  await robots.button('Resume').click();
  await expect(robots.jog('higher')).toBeVisible();
  // The pose that the stop holds is the last one.
  expect(ofKind(await robot.bus(), 'move').length - moves).toBeLessThanOrEqual(2);
});

test('a figure that cannot be is kept in its field and says why; the others are taken and undone', async ({
  dashboard,
  page,
}) => {
  const robots = robotDialogOf(dashboard);
  await robots.opener.click();
  await robots.button('Edit').click();
  const lowest = robots.cell('Lowest', 'Elbow');
  await lowest.fill('2600');
  await lowest.press('Enter');
  await expect(lowest).toHaveValue('2600');
  await expect(lowest).toHaveAccessibleDescription(/lowest position 2600 is not below its highest 2500/);
  await expect(robots.cell('Lowest', 'Shoulder')).toBeFocused();

  await lowest.fill('700');
  await lowest.press('Enter');
  await expect(lowest).toHaveAttribute('aria-invalid', 'false');
  await robots.dialog.getByRole('checkbox', { name: 'Reversed of Elbow' }).check();
  await page.keyboard.press('ControlOrMeta+z');
  await expect(robots.dialog.getByRole('checkbox', { name: 'Reversed of Elbow' })).not.toBeChecked();
  await expect(lowest).toHaveValue('700');
  await robots.button('Undo: Lowest of Elbow').click();
  await expect(lowest).toHaveValue('500');

  const place = robots.dialog.getByRole('button', { name: /^Servo 4, Elbow, at / });
  const before = await place.getAttribute('aria-label');
  await place.press('ArrowRight');
  await expect(place).not.toHaveAttribute('aria-label', before ?? '');
  await page.keyboard.press('ControlOrMeta+z');
  await expect(place).toHaveAttribute('aria-label', before ?? '');

  const drawn = robots.dialog.getByRole('combobox', { name: 'Drawn as' });
  await drawn.selectOption('Plain, dials only');
  await robots.button('Undo: Drawn as').click();
  await expect(drawn.getByRole('option', { selected: true })).toHaveText('Arm');
  await drawn.selectOption('Plain, dials only');

  await robots.button('Remove Base').click();
  await expect(robots.row('Servo 6, Base')).toBeHidden();
  await robots.button('Add servo').click();
  await expect(robots.row('Servo 6, Servo 6')).toBeVisible();
});

test('a robot goes to a file and comes back; a file that is none changes nothing', async ({
  dashboard,
  page,
}) => {
  const robots = robotDialogOf(dashboard);
  await robots.opener.click();
  const downloading = page.waitForEvent('download');
  await robots.button('Export').click();
  const download = await downloading;
  expect(download.suggestedFilename()).toBe('Arm.json');
  const text = (await download.text()).replace('"Arm"', '"Desk arm"');

  const choose = async (name: string, content: string): Promise<void> => {
    const chooser = page.waitForEvent('filechooser');
    await robots.button('Import a robot file').click();
    await (
      await chooser
    ).setFiles({ name, mimeType: 'application/json', buffer: new TextEncoder().encode(content) });
  };
  await choose('holiday.json', '{}');
  await expect(robots.dialog).toContainText('holiday.json was not imported: this is not a robot file');
  await choose('low.json', text.replace('"min": 500', '"min": 100'));
  await expect(robots.dialog).toContainText('low.json was not imported: Gripper (servo 1): ');
  await choose('fast.json', text.replace('"degreesPerUnit": 0.09', '"degreesPerUnit": 3'));
  await expect(robots.dialog).toContainText(
    'fast.json was not imported: Gripper (number 1 of the servos): “degreesPerUnit” takes a number above 0, 2 at most.',
  );
  await choose('desk.json', text);
  await expect(robots.dialog).toContainText('Desk arm is imported.');
  await expect(robots.dialog.getByText('Desk arm', { exact: true })).toBeInViewport();
  await expect(robots.button('Calibrate')).toBeFocused();
  await robots.button('Delete').click();
  await robots.button('Undo: remove robot').click();
  await robots.button('Close').click();
  await expect(robots.opener).toHaveAccessibleName('Robot: Desk arm');
  await page.reload();
  await expect(robots.opener).toHaveAccessibleName('Robot: Desk arm');
});
