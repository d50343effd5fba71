// Driving by pad and keys: only when switched on, only while held, and STOP is in the hand. What the board heard is the judge.

import type { Page } from './harness/page.ts';
import { lastTarget, ofKind, type Bus } from '../../e2e/fixtures/bus.ts';
import { READY } from '../../e2e/fixtures/dashboard.ts';
import { plugInPad, type SyntheticPad } from '../../e2e/fixtures/padInPage.ts';
import { expect, poll, test, type Dashboard } from './harness/test.ts';
import { advance, FRAME_MS } from './harness/time.ts';

/** Numbers of the standard pad, as the ready mapping uses them. */
const STOP = 1;
const LEFT_BUTTON = 2;
const RIGHT_TRIGGER = 7;

/** Plugged in before the page opens. */
let pad: SyntheticPad;
test.beforeEach(async ({ page }) => {
  pad = await plugInPad(page as unknown as Parameters<typeof plugInPad>[0]);
});

const driveSwitch = (page: Page) => page.getByRole('switch', { name: 'Drive' });

async function switchOn(page: Page): Promise<void> {
  await page.getByRole('radio', { name: 'Keys and pad' }).check();
  await driveSwitch(page).check();
  // What is held when driving begins moves nothing: a frame has to see it let go.
  await page.evaluate(async () => {
    for (let frame = 0; frame < 4; frame += 1) await new Promise(requestAnimationFrame);
  });
}

/** Switched on, with servo 1 at 1500 and known. */
async function startDriving(dashboard: Dashboard): Promise<void> {
  await dashboard.type(dashboard.target(1), 1500);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1500');
  await switchOn(dashboard.page);
}

/** What was asked for longer ago moves nothing any more. */
const OLDEST_MOVE_MS = 500;

/** A field follows four times a second; a servo that comes to rest is noticed within a tenth of one, and a frame later written. */
const LATEST_MS = 250 + 100 + 2 * FRAME_MS;

/** Nothing more leaves than what is on its way already. */
async function expectRest(bus: Bus): Promise<void> {
  let moves = -1;
  let sinceMs = 0;
  await poll(async () => {
    const { length } = ofKind(await bus(), 'move');
    if (length !== moves) [moves, sinceMs] = [length, Date.now()];
    return Date.now() - sinceMs;
  }).toBeGreaterThan(OLDEST_MOVE_MS);
}

test('a pad moves nothing before it is switched on, then while it is held, and stops', async ({
  dashboard,
  robot,
  page,
}) => {
  await pad.hold(RIGHT_TRIGGER);
  await dashboard.type(dashboard.target(1), 1500);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1500');
  expect(ofKind(await robot.bus(), 'move')).toHaveLength(1);

  await startDriving(dashboard);
  await expect(page.getByRole('radio', { name: 'Keys and pad, driving' })).toBeVisible();
  await pad.hold();
  await expect(page.getByRole('figure', { name: 'Synthetic pad' })).toBeVisible();
  expect(ofKind(await robot.bus(), 'move')).toHaveLength(1);

  await pad.hold(RIGHT_TRIGGER);
  await poll(() => lastTarget(robot.bus, 1)).toBeGreaterThan(1700);
  await pad.hold();
  await expectRest(robot.bus);
  expect(await lastTarget(robot.bus, 1)).toBeLessThan(2500);

  await pad.hold(STOP);
  await expect(dashboard.status).toContainText('Stop sent');
  await expect(driveSwitch(page)).not.toBeChecked();
  await pad.hold();
  await dashboard.resume.click();
  await expectRest(robot.bus);
  const before = ofKind(await robot.bus(), 'move').length;
  await pad.hold(RIGHT_TRIGGER);
  await dashboard.battery.getByRole('button', { name: 'Refresh' }).click();
  await poll(async () => (await robot.bus()).at(-1)?.command.kind).toBe('readBattery');
  expect(ofKind(await robot.bus(), 'move')).toHaveLength(before);
});

test('a held key turns its servo; leaving the window ends it though the key is never let go', async ({
  dashboard,
  robot,
  page,
}) => {
  await startDriving(dashboard);
  await page.keyboard.down('q');
  await poll(() => lastTarget(robot.bus, 1)).toBeGreaterThan(1600);
  await page.evaluate(() => window.dispatchEvent(new Event('blur')));
  await expectRest(robot.bus);
  const reached = await lastTarget(robot.bus, 1);
  expect(reached).toBeLessThan(2500);
  await page.evaluate(() => window.dispatchEvent(new Event('focus')));
  await expectRest(robot.bus);
  expect(await lastTarget(robot.bus, 1)).toBe(reached);
});

test('the curve shows where a stick is and what comes of it, without driving', async ({
  dashboard,
  page,
}) => {
  await expect(dashboard.link).toHaveText(READY);
  await page.getByRole('radio', { name: 'Keys and pad' }).check();
  const dot = page.getByRole('img', { name: 'Stick deflection and resulting speed' }).locator('circle');
  const at = () => dot.evaluate((circle) => circle.style.translate);
  await pad.push(0.1);
  await expect.poll(at).toBe('4px');
  await pad.push(1);
  await expect.poll(at).toBe('40px -40px');
});

test('what a screen reader finds in a field is where the pad takes its servo', async ({
  dashboard,
  robot,
}) => {
  await startDriving(dashboard);
  await pad.hold(RIGHT_TRIGGER);
  const sent: number[] = [];
  for (let looks = 0; looks < 8; looks += 1) {
    await advance(LATEST_MS);
    const field = Number(await dashboard.target(1).inputValue());
    expect(field).toBeGreaterThanOrEqual(sent.at(-1) ?? 1500);
    sent.push((await lastTarget(robot.bus, 1)) ?? NaN);
  }
  expect(sent.at(-1)).toBeGreaterThan(1700);
});

test('T keeps what the pad has just done, also while it drives', async ({ dashboard, robot, page }) => {
  await startDriving(dashboard);
  await pad.hold(RIGHT_TRIGGER);
  await poll(() => lastTarget(robot.bus, 1)).toBeGreaterThan(1700);
  await pad.hold();
  await page.keyboard.press('t');
  const dialog = page.getByRole('dialog', { name: 'Recorded motion' });
  await expect(dialog).toContainText(/positions become \d+ keys/);
});

test('servos of unknown position are asked for and go home slowly', async ({ dashboard, robot, page }) => {
  await switchOn(page);
  await pad.hold(RIGHT_TRIGGER);
  await expect(dashboard.notices).toContainText('Gripper does not move: its position is unknown.');
  expect(ofKind(await robot.bus(), 'move')).toEqual([]);
  await pad.hold();
  await dashboard.button('First move, slowly').click();
  await poll(async () => ofKind(await robot.bus(), 'move').length).toBeGreaterThan(0);
  expect(ofKind(await robot.bus(), 'move')[0]?.durationMs).toBeGreaterThanOrEqual(1500);
  await expect(dashboard.button('First move, slowly')).toBeHidden();
});

test('an input is bound by pressing it, says what it conflicts with, and is kept', async ({
  dashboard,
  page,
}) => {
  await page.getByRole('radio', { name: 'Keys and pad' }).check();
  await dashboard.button('Add a key or stick').click();
  await pad.hold(RIGHT_TRIGGER);
  const form = page.getByRole('form', { name: 'Action of Right trigger' });
  await form.getByRole('combobox', { name: 'Action', exact: true }).selectOption('Run a slot');
  await dashboard.type(form.getByRole('textbox', { name: 'Slot to run' }), 7);
  const conflicts = page.getByRole('list', { name: 'Conflicts' });
  await expect(conflicts).toHaveText('Right trigger is bound to Gripper and to Run slot 7.');

  await page.reload();
  await page.getByRole('radio', { name: 'Keys and pad' }).check();
  await expect(driveSwitch(page)).not.toBeChecked();
  await dashboard.button('Right trigger for Gripper').click();
  await dashboard.button('Unbind').click();
  await expect(conflicts).toBeHidden();
  await dashboard.button('Undo: unbind Right trigger').click();
  await expect(conflicts).toBeVisible();
});

test('a button of the pad goes to a pose in the time that was chosen', async ({ dashboard, robot, page }) => {
  await page.getByRole('radio', { name: 'Keys and pad' }).check();
  await dashboard.button('Add a key or stick').click();
  await pad.hold(LEFT_BUTTON);
  const form = page.getByRole('form', { name: 'Action of X' });
  await pad.hold();
  await form.getByRole('combobox', { name: 'Action', exact: true }).selectOption('Go to a pose');
  await form.getByRole('combobox', { name: 'Pose to go to' }).selectOption('Home');
  await form.getByRole('textbox', { name: 'Time to reach a pose in milliseconds' }).fill('2500');
  await dashboard.button('Bind').click();
  const rows = page.getByRole('list', { name: 'Bindings of keys and sticks' });
  await expect(rows.getByRole('listitem').filter({ hasText: 'Go to Home' })).toContainText('X');

  await switchOn(page);
  await pad.hold(LEFT_BUTTON);
  await poll(() => lastTarget(robot.bus, 6)).toBe(1500);
  const [first] = ofKind(await robot.bus(), 'move');
  expect(first?.durationMs).toBe(2500);
});

test('pulling the pad while it is held ends the motion', async ({ dashboard, robot, page }) => {
  await startDriving(dashboard);
  await pad.hold(RIGHT_TRIGGER);
  await poll(() => lastTarget(robot.bus, 1)).toBeGreaterThan(1600);
  await pad.unplug();
  await expect(dashboard.notices).toContainText('The pad was disconnected.');
  await expect(driveSwitch(page)).not.toBeChecked();
  await expectRest(robot.bus);
  expect(await lastTarget(robot.bus, 1)).toBeLessThan(2500);
});

test('the stick moves the tip of the arm instead of a joint, and undo takes the choice back', async ({
  dashboard,
  robot,
  page,
}) => {
  for (const [servo, position] of [
    [3, 1500],
    [4, 1900],
    [5, 1900],
    [6, 1500],
  ] as const) {
    await dashboard.type(dashboard.target(servo), position);
    await expect(dashboard.estimate(servo)).toHaveText(`≈ ${position}`);
  }
  await switchOn(page);
  await page.getByRole('radio', { name: 'Tip', exact: true }).check();
  await expect(page.getByRole('switch', { name: 'Keep the end level' })).toBeVisible();
  await pad.push(0);
  await pad.hold();
  await pad.push(1);
  await poll(() => lastTarget(robot.bus, 6)).toBeGreaterThan(1520);
  await pad.push(0);
  await expectRest(robot.bus);
  // Sideways in a straight line takes more than the base.
  expect(await lastTarget(robot.bus, 5)).not.toBe(1900);
  await dashboard.button('Undo: joints or tip').click();
  await expect(page.getByRole('radio', { name: 'Joints', exact: true })).toBeChecked();
});

test('driving ends where the keys belong to buttons', async ({ dashboard, page }) => {
  await startDriving(dashboard);
  await page.getByRole('radio', { name: 'Buttons' }).check();
  await page.getByRole('radio', { name: 'Animate' }).check();
  await expect(driveSwitch(page)).not.toBeChecked();
});
