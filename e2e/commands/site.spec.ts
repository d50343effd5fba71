// `npm run build:site` as a person meets it who has the page from a web server below some path: it works without a gateway and
// without a network, and takes a new version only when a person says so.

import { appendFileSync, cpSync } from 'node:fs';
import path from 'node:path';
import { at, mustRun } from '../../scripts/steps.mjs';
import { lastTarget } from '../fixtures/bus.ts';
import { dashboardOf, type Dashboard } from '../fixtures/dashboard.ts';
import { bundlePort, createRobotInPage } from '../fixtures/robotInPage.ts';
import { startStaticServer } from '../fixtures/staticServer.ts';
import { expect, poll, test } from '../fixtures/test.ts';

// One after the other: each worker would build the site.
test.describe.configure({ mode: 'default' });
test.beforeAll('the site is built', () =>
  mustRun('build the site', process.execPath, ['scripts/build_site.mjs']),
);

/** Reading, pointing and pressing. */
const SECONDS_PER_ACT = 4;

/** The simulated arm has greeted, and the worker has all files. */
async function settled({ page, status }: Dashboard): Promise<void> {
  await page.evaluate(() => navigator.serviceWorker.ready.then(() => undefined));
  await expect(status).toHaveText('Idle');
}

test('a site without a gateway works without a network, and is updated when a person says so', async ({
  page,
  context,
  scratch,
}) => {
  cpSync(at('build/site'), scratch, { recursive: true });
  const server = await startStaticServer({ folder: scratch, below: '/robots/arm/' });
  const dashboard = dashboardOf(page);
  await page.goto(server.url);
  await settled(dashboard);
  await page.waitForLoadState('networkidle'); // it fetches its later parts while nobody does anything

  await context.setOffline(true);
  await page.reload();
  await settled(dashboard);
  await dashboard.type(dashboard.target(1), 1800);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1800');
  await dashboard.capture.click();
  await page.reload();
  await expect(dashboard.frames).toHaveCount(1);
  await context.setOffline(false);

  appendFileSync(path.join(scratch, 'sw.js'), '// another version\n');
  await page.reload();
  await expect(dashboard.notices).toContainText('A new version of Servodeck is available.');
  await dashboard.type(dashboard.target(1), 600);
  await dashboard.button('Update and reload').click();
  await expect(dashboard.notices).toContainText('The robot is moving.');
  await expect(dashboard.estimate(1)).toHaveText('≈ 600');
  const other = await context.newPage();
  await other.goto(server.url);
  await dashboard.button('Update and reload').click();
  await expect(dashboard.notices).toContainText('Close the other Servodeck tabs');
  await other.close();
  const reloaded = page.waitForEvent('load');
  await dashboard.button('Update and reload').click();
  await reloaded;
  await expect(dashboard.frames).toHaveCount(1);
  await expect(dashboard.notices).not.toContainText('new version');
  await server.end();
});

test('from a served page to the first motion of a connected board in 20 s, at four seconds an act @exhaustive', async ({
  page,
}) => {
  const server = await startStaticServer({ folder: at('build/site'), below: '/robots/arm/' });
  const robot = await createRobotInPage(page, server.url, await bundlePort(), {});
  const dashboard = dashboardOf(page);
  await page.goto(server.url);
  const acts: readonly (() => Promise<void>)[] = [
    () => dashboard.button('Connect').click(),
    () => dashboard.button('Choose a port').click(),
    // A person selects it in the browser's chooser, which the port in the page does by itself.
    () => Promise.resolve(),
    () => dashboard.takeFor('LSC-compatible board').click(),
    () => dashboard.type(dashboard.target(1), 1800),
  ];
  for (const act of acts) await act();
  await poll(() => lastTarget(robot.bus, 1)).toBe(1800);
  expect(acts.length * SECONDS_PER_ACT).toBeLessThanOrEqual(20);
  await server.end();
});
