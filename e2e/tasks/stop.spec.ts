// STOP: from anywhere, at once, and nothing moves again before Resume. What the board heard is the judge.

import type { Page } from '@playwright/test';
import { kindsAfter, lastTarget, ofKind, type Bus } from '../fixtures/bus.ts';
import type { Dashboard } from '../fixtures/dashboard.ts';
import { captureGroup, downloadGroup } from '../fixtures/group.ts';
import { watchPress } from '../fixtures/press.ts';
import { SLOW_FLASH } from '../fixtures/robot.ts';
import { expect, poll, test } from '../fixtures/test.ts';

/**
 * 20 ms to the wire, 107 ms at most for the packet on it (safety.md section 1), and room for a machine that runs several
 * browsers at once: the benchmark measures, this only notices a STOP that waits for something.
 */
const LIMIT_MS = 400;

/** Stops by `press` and checks all that the board hears of it. Returns how many commands that were. */
async function stopAndCheck(page: Page, bus: Bus, press: () => Promise<void>): Promise<number> {
  const before = (await bus()).length;
  const pressedAtMs = await watchPress(page);
  await press();
  // One move may hold the robot where it is, right after the first stop and once more at the end.
  await poll(() => sequenceAfter(bus, before)).toMatch(/^stop( move)? stop stop\1$/);
  await expect(page.getByRole('banner').getByRole('status')).toContainText('Stop sent');

  const heard = (await bus()).slice(before);
  const first = heard.find(({ command }) => command.kind === 'stop')!;
  expect(first.beganAtMs - (await pressedAtMs())).toBeLessThan(LIMIT_MS);
  return before + heard.length;
}

/** What the board heard from the first stop on, in kinds; a question about the battery is always allowed. */
async function sequenceAfter(bus: Bus, count: number): Promise<string> {
  const kinds = (await kindsAfter(bus, count)).filter((kind) => kind !== 'readBattery');
  return kinds.slice(kinds.indexOf('stop')).join(' ');
}

/** A question that is always allowed comes through, and nothing before it moved anything. */
async function expectStillness(dashboard: Dashboard, bus: Bus, since: number): Promise<void> {
  const asked = ofKind(await bus(), 'readBattery').length;
  await dashboard.battery.getByRole('button', { name: 'Refresh' }).click();
  await poll(async () => ofKind(await bus(), 'readBattery').length).toBeGreaterThan(asked);
  const kinds = await kindsAfter(bus, since);
  expect(kinds.filter((kind) => kind !== 'readBattery')).toEqual([]);
}

test('STOP holds a moving servo where it is, and only Resume lets it move again @everyWay', async ({
  dashboard,
  robot,
  page,
}) => {
  await dashboard.type(dashboard.target(1), 1500);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1500');
  await page.getByRole('radio', { name: 'In a set time' }).check();
  await dashboard.type(dashboard.field('Move time in milliseconds'), 5000);
  await dashboard.type(dashboard.target(1), 2500);
  await expect(dashboard.estimate(1)).toHaveText(/≈ 1(5[1-9]|[6-9]\d)\d/);
  const since = await stopAndCheck(page, robot.bus, () => dashboard.stop.click());
  const hold = ofKind(await robot.bus(), 'move').at(-1)!;
  expect(hold.targets).toHaveLength(1);
  expect(hold.targets[0]!.position).toBeGreaterThan(1500);
  expect(hold.targets[0]!.position).toBeLessThan(2400);

  await expect(dashboard.slider(1)).toHaveAttribute('aria-disabled', 'true');
  await dashboard.slider(1).press('ArrowRight');
  await expect(dashboard.target(1)).not.toBeEditable();
  await expect(dashboard.button('Run')).toBeDisabled();
  await expectStillness(dashboard, robot.bus, since);

  await dashboard.resume.click();
  await expect(dashboard.status).toHaveText('Idle');
  await expectStillness(dashboard, robot.bus, since);
  await dashboard.type(dashboard.target(1), 1600);
  await poll(() => lastTarget(robot.bus, 1)).toBe(1600);
});

test('STOP ends a group that runs until stopped', async ({ dashboard, robot, page }) => {
  await captureGroup(dashboard, [1000, 1600], 200);
  await downloadGroup(dashboard, 5, 1600);
  await dashboard.untilStopped.check();
  await dashboard.button('Run').click();
  await expect(dashboard.status).toContainText('received by the board');
  const since = await stopAndCheck(page, robot.bus, () => dashboard.stop.click());
  await expectStillness(dashboard, robot.bus, since);
});

test('STOP ends playing from the page', async ({ dashboard, robot, page }) => {
  await captureGroup(dashboard, [1000, 1200, 1400]);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1400');
  await dashboard.button('Play').click();
  // A frame lasts a second, and so do the pauses in which a text is otherwise looked at.
  await poll(() => dashboard.status.textContent()).toBe('Playing frame 2 of 3');
  const since = await stopAndCheck(page, robot.bus, () => dashboard.stop.click());
  await expectStillness(dashboard, robot.bus, since);
});

test.describe('on a board with slow flash', () => {
  test.use({ boardSettings: SLOW_FLASH });

  test('STOP breaks off a download and says that the slot is broken', async ({ dashboard, robot, page }) => {
    await captureGroup(dashboard, [1000, 1010, 1020]);
    await expect(dashboard.estimate(1)).toHaveText('≈ 1020');
    await dashboard.button('Download').click();
    await expect(dashboard.progress).toHaveAttribute('aria-valuetext', '0 of 3 frames');
    const since = await stopAndCheck(page, robot.bus, () => dashboard.stop.click());
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
  await stopAndCheck(page, robot.bus, () => page.keyboard.press('Escape'));
  await dashboard.resume.click();
  await dashboard.target(2).fill('12');
  await stopAndCheck(page, robot.bus, () => page.keyboard.press('Escape'));
  await dashboard.resume.click();
  await dashboard.link.click();
  await expect(dashboard.connectDialog).toBeVisible();
  await stopAndCheck(page, robot.bus, () => page.keyboard.press('Escape'));
  await expect(dashboard.connectDialog).toBeHidden();
});

test('STOP acts on press, not on release, and over an open dialog', async ({ dashboard, robot, page }) => {
  await dashboard.button('Erase everything').click();
  await expect(page.getByRole('alertdialog')).toBeVisible();
  await dashboard.stop.hover();
  await stopAndCheck(page, robot.bus, () => page.mouse.down());
  await page.mouse.up();
  expect(ofKind(await robot.bus(), 'erase')).toEqual([]);
});
