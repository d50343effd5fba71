// A window that stands still, as browsers do with tabs nobody looks at and computers with their lid closed: it moves nothing
// when it wakes, whatever it had in mind, and a person who goes on meanwhile is not hindered.

import type { CDPSession } from '@playwright/test';
import { kindsAfter, lastTarget, ofKind } from '../fixtures/bus.ts';
import { anotherBrowser, dashboardOf } from '../fixtures/dashboard.ts';
import { captureGroup } from '../fixtures/group.ts';
import { expect, poll, test } from '../fixtures/test.ts';

const FRAME_MS = 2_000;

/** Its connection stays open and what comes is kept; no line of it runs, no timer fires. Chromium freezes no window that is seen. */
async function freeze(window: CDPSession): Promise<void> {
  await window.send('Debugger.enable');
  const stands = new Promise((resolve) => window.once('Debugger.paused', resolve));
  await window.send('Debugger.pause');
  await stands;
}

test('a window that froze while it played wakes, and moves nothing @exhaustive', async ({
  dashboard,
  robot,
  browser,
}) => {
  await captureGroup(dashboard, [1100, 1500, 1200, 1600], FRAME_MS);
  const elsewhere = await anotherBrowser(browser);
  const other = dashboardOf(await elsewhere.newPage());
  await robot.open(other.page);
  await dashboard.button('Play').click();
  await expect(dashboard.status).toHaveText('Playing frame 2 of 4');

  const window = await dashboard.page.context().newCDPSession(dashboard.page);
  const before = (await robot.bus()).length;
  await freeze(window);
  await poll(async () => ofKind((await robot.bus()).slice(before), 'stop').length).toBeGreaterThanOrEqual(3);
  await expect(other.status).toContainText('The driver disconnected while the robot moved');
  await other.turn.getByRole('button', { name: 'Take over', exact: true }).click();
  await expect(other.turn).toContainText('You drive');
  // The latch shall not be what keeps it still.
  await other.resume.click();
  await other.type(other.target(2), 1700);
  await poll(() => lastTarget(robot.bus, 2)).toBe(1700);

  const asleep = (await robot.bus()).length;
  await window.send('Debugger.disable');
  await expect(dashboard.turn).toContainText('Another window drives');
  await expect(dashboard.status).not.toContainText('Playing');
  expect(await kindsAfter(robot.bus, asleep)).toEqual([]);
  await other.type(other.target(2), 1600);
  await poll(() => lastTarget(robot.bus, 2)).toBe(1600);
  expect(await kindsAfter(robot.bus, asleep)).toEqual(['move']);
  await elsewhere.close();
});
