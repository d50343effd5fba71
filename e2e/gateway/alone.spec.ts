// What drives without a page: a run that goes on after its page has gone, and a script. Both are seen and can be stopped.

import { lastTarget, ofKind } from '../fixtures/bus.ts';
import { dashboardOf, READY } from '../fixtures/dashboard.ts';
import { captureGroup, downloadGroup } from '../fixtures/group.ts';
import { expect, poll, test } from '../fixtures/test.ts';

test('a run that may go on outlives its page; the next page sees it, and stops it', async ({
  dashboard,
  robot,
  context,
}) => {
  await captureGroup(dashboard, [1000, 1600], 500);
  await downloadGroup(dashboard, 6, 1600);
  await dashboard.type(dashboard.times, 100);
  await dashboard.goOn.check();
  await dashboard.type(dashboard.field('Minutes at most'), 5);
  await dashboard.button('Run').click();
  await expect(dashboard.alone).toContainText('Slot 6 may keep running without you');
  await expect(dashboard.goOn).not.toBeChecked();
  await dashboard.page.close();

  const before = (await robot.bus()).length;
  const next = dashboardOf(await context.newPage());
  await robot.open(next.page);
  await expect(next.link).toHaveText(READY);
  await expect(next.alone).toContainText('Slot 6 keeps running without another window');
  // Longer than anybody's silence is waited for.
  await expect(next.alone).toContainText(/4:5[0-5]/, { timeout: 15_000 });
  expect(ofKind((await robot.bus()).slice(before), 'stop')).toHaveLength(0);

  await next.stop.click();
  await poll(async () => ofKind((await robot.bus()).slice(before), 'stop').length).toBeGreaterThanOrEqual(3);
  await expect(next.alone).toHaveCount(0);
});

test('an endless run that may go on can be bound to its page again, and then ends with it @exhaustive', async ({
  dashboard,
  robot,
  context,
}) => {
  await captureGroup(dashboard, [1000, 1600], 500);
  await downloadGroup(dashboard, 6, 1600);
  await dashboard.untilStopped.check();
  await dashboard.goOn.check();
  await dashboard.button('Run').click();
  await dashboard.alone.getByRole('button', { name: 'End it when I leave' }).click();
  await expect(dashboard.alone).toHaveCount(0);
  await context.newPage();
  const before = (await robot.bus()).length;
  await dashboard.page.close();
  await poll(async () => ofKind((await robot.bus()).slice(before), 'stop').length).toBeGreaterThanOrEqual(3);
});

test('a pose that a page has captured can be gone to by a script @exhaustive', async ({
  dashboard,
  robot,
  request,
}) => {
  const { page } = dashboard;
  const { origin } = new URL(page.url());
  await page.getByRole('radio', { name: 'Poses' }).check();
  await dashboard.type(dashboard.target(1), 1777);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1777');
  await dashboard.button('Capture pose').click();
  await expect
    .poll(async () => (await (await request.get(`${origin}/api/poses`)).json()) as unknown)
    .toMatchObject({ poses: [{ name: 'home' }, { targets: [{ servo: 1, position: 1777 }] }] });
  await dashboard.type(dashboard.target(1), 1234);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1234');
  const answer = await request.post(`${origin}/api/poses/1/apply`, { data: { take: true } });
  expect(await answer.json()).toMatchObject({ overInMs: 1500 });
  await poll(() => lastTarget(robot.bus, 1)).toBe(1777);
});

test('a script drives under its name, and the page that is alone beside it sees that @exhaustive', async ({
  dashboard,
  robot,
  request,
}) => {
  const { origin } = new URL(dashboard.page.url());
  const answer = await request.post(`${origin}/api/move`, {
    data: { timeMs: 3000, positions: { 1: 1800 } },
  });
  expect(answer.ok()).toBe(true);
  await expect(dashboard.turn).toContainText('A script on this computer drives');
  await poll(() => lastTarget(robot.bus, 1)).toBe(1800);
  await expect(dashboard.target(1)).toHaveValue('1800');
  await expect(dashboard.turn).toHaveCount(0, { timeout: 10_000 });
});
