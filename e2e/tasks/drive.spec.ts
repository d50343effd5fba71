// Moving servos: by slider, by number, in a set time.

import { lastTarget } from '../fixtures/bus.ts';
import { expect, test } from '../fixtures/test.ts';

test('a connected board is asked nothing that moves @everyWay', async ({ dashboard, robot }) => {
  await expect(dashboard.battery).toContainText('7.50 V');
  const kinds = (await robot.bus()).map(({ command }) => command.kind);
  expect(kinds.filter((kind) => kind !== 'stop' && kind !== 'readBattery')).toEqual([]);
});

test('a slider moved by key moves the servo, and the estimate follows @everyWay', async ({
  dashboard,
  robot,
}) => {
  await dashboard.slider(3).press('ArrowRight');
  await expect(dashboard.slider(3)).toHaveAttribute('aria-valuetext', '1510 µs');
  await expect.poll(() => lastTarget(robot.bus, 3)).toBe(1510);
  await expect(dashboard.estimate(3)).toHaveText('≈ 1510');
});
