// Moving servos over each way. What the panel itself does is in frontend/tests/.

import { lastTarget, ofKind } from '../fixtures/bus.ts';
import { expect, poll, test } from '../fixtures/test.ts';

test('connecting asks nothing of the board that moves it; the battery is read, also when wanted', async ({
  dashboard,
  robot,
}) => {
  await expect(dashboard.battery).toContainText('7.50 V');
  await expect(dashboard.battery).toContainText(/\d sec\. ago/);
  const kinds = (await robot.bus()).map(({ command }) => command.kind);
  expect(['stop', 'readBattery', 'readPositions']).toEqual(expect.arrayContaining(kinds));
  const asked = ofKind(await robot.bus(), 'readBattery').length;
  await dashboard.battery.getByRole('button', { name: 'Refresh' }).click();
  await poll(async () => ofKind(await robot.bus(), 'readBattery').length).toBeGreaterThan(asked);
});

test('a slider stepped by key moves the servo, slowly at first, and the estimate follows @everyWay', async ({
  dashboard,
  robot,
}) => {
  await expect(dashboard.stop).toBeInViewport({ ratio: 1 });
  await expect(dashboard.slider(3)).toBeInViewport({ ratio: 1 });
  await expect(dashboard.estimate(3)).toBeHidden();
  await dashboard.slider(3).press('ArrowRight');
  await expect(dashboard.slider(3)).toHaveAttribute('aria-valuetext', '1501 µs, commanded');
  await poll(() => lastTarget(robot.bus, 3)).toBe(1501);
  const [first] = ofKind(await robot.bus(), 'move');
  expect(first?.durationMs).toBeGreaterThanOrEqual(1500);
  await expect(dashboard.estimate(3)).toHaveText('≈ 1501');
  await expect(dashboard.servoRow(3).getByRole('group', { name: 'Estimated' })).toHaveText('≈ 1501');
});
