// Under the hood: the packet log says in words and bytes what went over the link.

import { lastTarget } from '../fixtures/bus.ts';
import { expect, poll, test } from '../fixtures/test.ts';

test('the log shows packets in words and in bytes, both ways, and can be thinned out', async ({
  dashboard,
  robot,
  page,
}) => {
  await dashboard.button('Show the log').click();
  await dashboard.type(dashboard.target(1), 2000);
  await poll(() => lastTarget(robot.bus, 1)).toBe(2000);
  await expect(dashboard.log).toContainText('Move 1 → 2000 in 1500 ms');
  await expect(dashboard.log).toContainText('55 55 08 03 01 DC 05 01 D0 07');
  await expect(dashboard.log).toContainText('Ask for the battery');
  await expect(dashboard.log).toContainText('Battery 7.50 V');
  await expect(dashboard.log).toContainText('55 55 04 0F 4C 1D');

  await page.getByRole('checkbox', { name: 'Battery' }).uncheck();
  await expect(dashboard.log).not.toContainText('Battery 7.50 V');
  await expect(dashboard.log).toContainText('Move 1 → 2000');
  await dashboard.button('Clear log').click();
  await expect(dashboard.log).not.toContainText('Move 1 → 2000');
});
