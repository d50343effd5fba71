// Setting an arm up from nothing, the shortest way through it that a person can see: which board, its servos, three poses, a pad. Each
// press, hold or drag counts as one act; more of them than now is a step backwards.

import type { Locator } from '@playwright/test';
import { dashboardOf, READY } from '../fixtures/dashboard.ts';
import { lastTarget, ofKind } from '../fixtures/bus.ts';
import { plugInPad } from '../fixtures/padInPage.ts';
import { createPtyBoard } from '../fixtures/ptyBoard.ts';
import { robotDialogOf } from '../fixtures/robotDialog.ts';
import { expect, poll, test } from '../fixtures/test.ts';

const SERVOS = ['Gripper', 'Wrist roll', 'Wrist', 'Elbow', 'Shoulder', 'Base'];
const RIGHT_TRIGGER = 7;

test('an arm is set up in 24 acts, and nothing moves that was not asked to', async ({
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
  await press(robots.button('Calibrate'));
  await press(robots.button('All 6 go home, one after another'));
  await expect(robots.dialog.getByText('≈ 1500')).toBeVisible({ timeout: 15_000 });
  // Of one servo everything is set, of the others only what is usual.
  await act(
    robots.creepUntil('lower', () =>
      poll(async () => (await lastTarget(board.bus, 1)) ?? 9999).toBeLessThan(1480),
    ),
  );
  await press(robots.button('Set lowest here'));
  await press(robots.button(/^Keep 2500/));
  await press(robots.button(/^Keep 1500/));
  await press(robots.button('Turn a little'));
  await expect(robots.button('Yes, that way')).toBeEnabled({ timeout: 15_000 });
  await press(robots.button('Yes, that way'));
  for (const servo of SERVOS.slice(1)) await press(robots.button(`Leave all of ${servo} as it is`));
  await press(robots.button('Go on to poses'));

  for (const [servo, position] of [
    [5, 1300],
    [4, 1700],
    [3, 1200],
  ] as const) {
    await act(dashboard.type(dashboard.target(servo), position));
    await press(dashboard.button('Capture pose'));
  }
  await expect(page.getByRole('button', { name: /^Go to Pose/ })).toHaveCount(3);

  await act(page.getByRole('radio', { name: 'Keys and pad' }).check());
  await act(page.getByRole('switch', { name: 'Drive' }).check());
  await pad.hold();
  const before = await lastTarget(board.bus, 1);
  await pad.hold(RIGHT_TRIGGER);
  await poll(() => lastTarget(board.bus, 1)).not.toBe(before);
  await pad.hold();
  expect(acts).toBe(24);
  await board.unplug();
});
