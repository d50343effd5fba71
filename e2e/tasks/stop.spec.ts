// STOP over each way. From anywhere, and of whatever goes on, is in frontend/tests/.

import { lastTarget, ofKind } from '../fixtures/bus.ts';
import { expectStillness, stopAndCheck } from '../fixtures/stopping.ts';
import { expect, poll, test } from '../fixtures/test.ts';

/** With room for a machine that runs several browsers: the benchmark measures, this only notices a STOP that waits for something. */
const LIMIT_MS = 400;

test('STOP holds a moving servo where it is, and only Resume lets it move again @everyWay', async ({
  dashboard,
  robot,
  page,
}) => {
  await dashboard.type(dashboard.target(1), 1500);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1500');
  await page.getByRole('radio', { name: 'Fixed time' }).check();
  await dashboard.type(dashboard.field('Move time in milliseconds'), 5000);
  await dashboard.type(dashboard.target(1), 2500);
  await expect(dashboard.estimate(1)).toHaveText(/≈ 1(5[1-9]|[6-9]\d)\d/);
  const since = await stopAndCheck(dashboard, robot.bus, () => dashboard.stop.click(), LIMIT_MS);
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
