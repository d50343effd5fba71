// STOP: from anywhere, at once, and nothing moves again before Resume. What the board heard is the judge.

import { ofKind, STOPS_OF_AN_END } from '../../e2e/fixtures/bus.ts';
import * as group from '../../e2e/fixtures/group.ts';
import { SLOW_FLASH } from '../../e2e/fixtures/robot.ts';
import * as stopping from '../../e2e/fixtures/stopping.ts';
import { expect, here, poll, test } from './harness/test.ts';
import { advance } from './harness/time.ts';

const { captureGroup, downloadGroup } = here(group);
const { expectStillness, stopAndCheck } = here(stopping);

test('STOP ends a group that runs until stopped', async ({ dashboard, robot }) => {
  await captureGroup(dashboard, [1000, 1600], 200);
  await downloadGroup(dashboard, 5, 1600);
  await dashboard.untilStopped.check();
  await dashboard.button('Run').click();
  await expect(dashboard.status).toContainText('received by the board');
  const since = await stopAndCheck(dashboard, robot.bus, () => dashboard.stop.click());
  await expectStillness(dashboard, robot.bus, since);
});

test('behind the end of a group that the board alone knows STOP says for how long the robot may move on', async ({
  dashboard,
  robot,
  page,
}) => {
  // What was under way before the page came is over by now.
  await dashboard.type(dashboard.target(1), 1500);
  await advance(31_000);
  await stopAndCheck(dashboard, robot.bus, () => dashboard.stop.click());
  await expect(page.getByText(/may keep moving/)).toHaveCount(0);
  await dashboard.resume.click();
  await dashboard.type(dashboard.slot, 77);
  await dashboard.button('Run').click();
  await expect(dashboard.status).toContainText('received by the board');
  const stops = async () => ofKind(await robot.bus(), 'stop').length;
  const before = await stops();
  await dashboard.button('End group').click();
  await poll(stops).toBe(before + STOPS_OF_AN_END);
  await dashboard.stop.click();
  await expect(dashboard.status).toContainText(/The robot may keep moving for up to \d+\.\d s/);
});

test('STOP ends playing from the page', async ({ dashboard, robot }) => {
  await captureGroup(dashboard, [1000, 1200, 1400]);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1400');
  await dashboard.button('Play').click();
  // A frame lasts a second, and so do the pauses in which a text is otherwise looked at.
  await poll(() => dashboard.status.textContent()).toBe('Playing frame 2 of 3');
  const since = await stopAndCheck(dashboard, robot.bus, () => dashboard.stop.click());
  await expectStillness(dashboard, robot.bus, since);
});

test.describe('on a board with slow flash', () => {
  test.override({ boardSettings: SLOW_FLASH });

  test('STOP breaks off a download and says that the slot is broken', async ({ dashboard, robot }) => {
    await captureGroup(dashboard, [1000, 1010, 1020]);
    await expect(dashboard.estimate(1)).toHaveText('≈ 1020');
    await dashboard.button('Download').click();
    await expect(dashboard.progress).toHaveAttribute('aria-valuetext', '0 of 3 frames');
    const since = await stopAndCheck(dashboard, robot.bus, () => dashboard.stop.click());
    await expect(dashboard.board).toContainText('Its download did not finish.');
    await expectStillness(dashboard, robot.bus, since);
  });
});

test('Esc is STOP in a text, in a number and in a dialog, and closes the dialog', async ({
  dashboard,
  robot,
  page,
}) => {
  await dashboard.field('Name of the group').fill('Half a na');
  await stopAndCheck(dashboard, robot.bus, () => page.keyboard.press('Escape'));
  await dashboard.resume.click();
  await dashboard.target(2).fill('12');
  await stopAndCheck(dashboard, robot.bus, () => page.keyboard.press('Escape'));
  await dashboard.resume.click();
  await dashboard.link.click();
  await expect(dashboard.connectDialog).toBeVisible();
  await stopAndCheck(dashboard, robot.bus, () => page.keyboard.press('Escape'));
  await expect(dashboard.connectDialog).toBeHidden();
});

test('STOP acts on press, not on release, and over an open dialog', async ({ dashboard, robot, page }) => {
  await dashboard.button('Erase everything').click();
  await expect(page.getByRole('alertdialog')).toBeVisible();
  await dashboard.stop.hover();
  await stopAndCheck(dashboard, robot.bus, () => page.mouse.down());
  await page.mouse.up();
  expect(ofKind(await robot.bus(), 'erase')).toEqual([]);
});
