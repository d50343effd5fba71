// The cable is pulled and comes back: the page says what happened and what to do, finds the board again by itself, and
// waits for a person before anything moves.

import { lastTarget, ofKind } from '../fixtures/bus.ts';
import { captureGroup } from '../fixtures/group.ts';
import { SLOW_FLASH } from '../fixtures/robot.ts';
import { ONCE_BACK, READY } from '../fixtures/dashboard.ts';
import { expect, poll, test } from '../fixtures/test.ts';

test('a pulled cable is reported, comes back without a reload, and moves only after Resume @everyWay', async ({
  dashboard,
  robot,
}) => {
  await captureGroup(dashboard, [1000, 1200]);
  await dashboard.type(dashboard.slot, 5);

  await robot.unplug();
  await expect(dashboard.link).toHaveText(/^Lost/);
  await expect(dashboard.status).toContainText(/Check the robot’s cable|Plug the robot in/);
  await expect(dashboard.bar).toContainText(/Next try in \d+ s/);
  await expect(dashboard.slider(1)).toHaveAttribute('aria-disabled', 'true');
  await expect(dashboard.button('Run')).toBeDisabled();
  await expect(dashboard.button('Download')).toBeDisabled();

  await robot.plugIn();
  await expect(dashboard.link).toHaveText(READY, ONCE_BACK);
  await expect(dashboard.status).toContainText('The link was restored; check the robot first');
  await expect(dashboard.frames).toHaveCount(2);
  await expect(dashboard.slot).toHaveValue('5');
  await expect(dashboard.estimate(1)).toBeHidden();
  const movesSoFar = ofKind(await robot.bus(), 'move').length;

  await dashboard.resume.click();
  await dashboard.type(dashboard.target(1), 1700);
  await poll(() => lastTarget(robot.bus, 1)).toBe(1700);
  const moves = ofKind(await robot.bus(), 'move');
  expect(moves).toHaveLength(movesSoFar + 1);
  expect(moves.at(-1)!.durationMs).toBeGreaterThanOrEqual(1500);
});

test.describe('on a board with slow flash', () => {
  test.use({ boardSettings: SLOW_FLASH });

  test('a cable pulled during a download leaves a slot that is known to be broken @exhaustive', async ({
    dashboard,
    robot,
  }) => {
    await captureGroup(dashboard, [1000, 1010, 1020]);
    await expect(dashboard.estimate(1)).toHaveText('≈ 1020');
    await dashboard.button('Download').click();
    await expect(dashboard.progress).toHaveAttribute('aria-valuetext', '0 of 3 frames');
    // Before its first frame has come the slot is what it was.
    await poll(async () => ofKind(await robot.bus(), 'download').length).toBe(1);
    await robot.unplug();
    await expect(dashboard.link).toHaveText(/^Lost/);
    await expect(dashboard.board).toContainText('Its download did not finish.');
    await expect(dashboard.notices).toContainText('Servodeck keeps trying');
    await robot.plugIn();
    await expect(dashboard.link).toHaveText(READY, ONCE_BACK);
    await expect(dashboard.notices).not.toContainText('Servodeck keeps trying');
    await dashboard.resume.click();
    await expect(dashboard.button('Run')).toBeDisabled();
    await expect(dashboard.button('Download')).toBeEnabled();
  });
});
