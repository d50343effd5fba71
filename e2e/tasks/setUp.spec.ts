// Setting an arm up from nothing, the shortest way through it that a person can see: which board and robot, its servos, three poses
// with names, a pad. Each press, hold, drag or name counts as one act; more of them than now is a step backwards.

import type { Locator } from '@playwright/test';
import { dashboardOf, READY } from '../fixtures/dashboard.ts';
import { lastTarget, ofKind } from '../fixtures/bus.ts';
import { plugInPad } from '../fixtures/padInPage.ts';
import { createPtyBoard } from '../fixtures/ptyBoard.ts';
import { robotDialogOf } from '../fixtures/robotDialog.ts';
import { expect, poll, test } from '../fixtures/test.ts';

const SERVOS = ['Gripper', 'Wrist roll', 'Wrist', 'Elbow', 'Shoulder', 'Base'];
const POSES = [
  ['Rest', 5, 1300],
  ['Reach', 4, 1700],
  ['Lift', 3, 1200],
] as const;
/** Of the ready mapping, on a standard pad. */
const STOP = 1;

test('an arm is set up in 33 acts, and nothing moves that was not asked to', async ({
  page,
  scratch,
  newGateway,
}) => {
  test.slow();
  let acts = 0;
  const act = async (what: Promise<unknown>): Promise<void> => {
    acts += 1;
    await what;
  };
  const press = (button: Locator): Promise<void> => act(button.click());

  const pad = await plugInPad(page);
  const board = await createPtyBoard(scratch, ['--board', 'openarm-new']);
  await board.plugIn();
  const gateway = await newGateway({ serial: board.device, board: 'unknown' });
  const dashboard = dashboardOf(page);
  await page.goto(gateway.url);
  await press(dashboard.takeFor('uHand 2.0 / OpenArm'));
  await expect(dashboard.link).toHaveText(READY);
  expect(ofKind(await board.bus(), 'move')).toEqual([]);

  const robots = robotDialogOf(dashboard);
  await press(robots.opener);
  await press(robots.button('Add Arm, 6 servos'));
  await press(robots.button('Calibrate'));
  await press(robots.button('All 6 go home, one after another'));
  await expect(robots.dialog.getByText('≈ 1500')).toBeVisible({ timeout: 15_000 });
  // Of one servo everything is set, of the others only what is usual.
  await act(
    robots.jogByMouse('lower', () =>
      poll(async () => (await lastTarget(board.bus, 1)) ?? 9999).toBeLessThan(1400),
    ),
  );
  await press(robots.button('Set lowest here'));
  await press(robots.button(/^Keep 2500/));
  await press(robots.button(/^Keep 1500/));
  // The way home shows which way it turns.
  await expect(robots.dialog.getByText('Does it close?')).toBeVisible();
  await press(robots.button('Yes, that way'));
  for (const servo of SERVOS.slice(1)) await press(robots.button(`Leave all of ${servo} as it is`));
  await press(robots.button('Continue with poses'));

  for (const [name, servo, position] of POSES) {
    await act(dashboard.type(dashboard.target(servo), position));
    await press(dashboard.button('Capture pose'));
    const field = page.getByRole('textbox', { name: /^Name of Pose/ });
    await field.fill(name);
    await act(field.press('Enter'));
  }
  for (const [name, servo, position] of POSES) {
    await press(page.getByRole('button', { name: new RegExp(`^Go to ${name}`) }));
    await poll(() => lastTarget(board.bus, servo)).toBe(position);
  }

  await act(page.getByRole('radio', { name: 'Keys and pad' }).check());
  await act(page.getByRole('switch', { name: 'Drive' }).check());
  await pad.hold();
  const before = await lastTarget(board.bus, 6);
  await act(pad.push(1));
  await poll(() => lastTarget(board.bus, 6)).not.toBe(before);
  await pad.push(0);
  await act(pad.hold(STOP));
  await expect(dashboard.status).toContainText('Stop sent');
  await pad.hold();
  await press(dashboard.resume);
  expect(acts).toBe(33);
  await board.unplug();
});
