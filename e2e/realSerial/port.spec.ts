// Nothing of Web Serial is made up here but the chooser: a real Chromium opens a real pty through its own serial code.
// Where umockdev is missing these are skipped, and the reason is told.

import path from 'node:path';
import { chromium, type BrowserContext } from '@playwright/test';
import { umockdevProblem } from '../../scripts/browser.mjs';
import { root } from '../../scripts/steps.mjs';
import { kindsAfter, lastTarget, ofKind } from '../fixtures/bus.ts';
import { dashboardOf, type Dashboard } from '../fixtures/dashboard.ts';
import { writeDeviceTree, writeProfile } from '../fixtures/mockDevice.ts';
import { expect, poll, test as base } from '../fixtures/test.ts';

const problem = umockdevProblem();

const test = base.extend<{ context: BrowserContext; openPort: Dashboard }>({
  context: async ({ servers, ptyBoard, launchOptions, viewport, scratch }, use) => {
    const [tree, profile] = [path.join(scratch, 'mock'), path.join(scratch, 'profile')];
    writeDeviceTree(tree, path.join(root, ptyBoard.device));
    writeProfile(profile, await originOf(servers));
    const context = await chromium.launchPersistentContext(profile, {
      ...launchOptions,
      viewport,
      // Chromium forks once more for its network service, and about once in fifty starts that fork waits for ever for a
      // lock of umockdev's that another thread held: inside the browser it needs no fork.
      args: [...(launchOptions.args ?? []), '--enable-features=NetworkServiceInProcess2'],
      env: { ...process.env, LD_PRELOAD: 'libumockdev-preload.so.0', UMOCKDEV_DIR: tree },
    });
    await use(context);
    await context.close();
  },

  openPort: async ({ servers, page }, use) => {
    await page.goto(await originOf(servers));
    const dashboard = dashboardOf(page);
    await dashboard.button('Connect').click();
    await dashboard.button('Open USB serial 1234:5678').click();
    await dashboard.takeFor('Generic board').click();
    await expect(dashboard.link).toHaveText(/^Ready/);
    await use(dashboard);
  },
});

async function originOf(servers: { files(): Promise<{ url: string }> }): Promise<string> {
  return (await servers.files()).url;
}

test.skip(problem !== null, `real Web Serial: ${problem}`);

test('a real port is opened and tells the battery', async ({ openPort, ptyBoard }) => {
  await expect(openPort.battery).toContainText('7.50 V');
  expect(new Set(await kindsAfter(ptyBoard.bus, 0))).toEqual(new Set(['readBattery', 'readPositions']));
});

test('a slider moves the servo behind a real port, and the estimate follows', async ({
  openPort,
  ptyBoard,
}) => {
  await openPort.slider(2).press('PageUp');
  await poll(() => lastTarget(ptyBoard.bus, 2)).toBe(1600);
  await expect(openPort.estimate(2)).toHaveText('≈ 1600');
});

test('STOP goes out three times over a real port, and holds', async ({ openPort, ptyBoard }) => {
  await openPort.type(openPort.target(1), 2000);
  await expect(openPort.estimate(1)).toHaveText('≈ 2000');
  await openPort.stop.click();
  await expect(openPort.status).toContainText('Stop sent');
  const heard = await ptyBoard.bus();
  expect(ofKind(heard, 'stop')).toHaveLength(3);
  expect(ofKind(heard, 'move').at(-1)?.targets).toEqual([{ servo: 1, position: 2000 }]);
});

test('an adapter that goes away is told as such', async ({ openPort, ptyBoard }) => {
  await ptyBoard.unplug();
  await expect(openPort.link).toHaveText(/^Lost/);
  await expect(openPort.status).toContainText(/Check the cable|Plug the robot in|Another program/);
  await expect(openPort.bar).toContainText(/Next try in \d+ s/);
});
