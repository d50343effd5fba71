// Nothing of Web Serial is made up here but the chooser: a real Chromium opens a real pty through its own serial code.
// Where umockdev is missing these are skipped, and the reason is reported.

import { kindsAfter, lastTarget, ofKind } from '../fixtures/bus.ts';
import { READY } from '../fixtures/dashboard.ts';
import { testOn } from '../fixtures/realDevice.ts';
import { expect, poll } from '../fixtures/test.ts';
import { USB_ADAPTER } from '../fixtures/mockDevice.ts';

const test = testOn(USB_ADAPTER);

test('a real port is opened and tells the battery @exhaustive', async ({ connected, ptyBoard }) => {
  await expect(connected.battery).toContainText('7.50 V');
  expect(new Set(await kindsAfter(ptyBoard.bus, 0))).toEqual(new Set(['readBattery', 'readPositions']));
});

test('a port that is open says so, and is not opened once more @exhaustive', async ({
  connected,
  ptyBoard,
}) => {
  const before = (await ptyBoard.bus()).length;
  await connected.link.click();
  await expect(connected.button('USB serial adapter (id 1234:5678) is open')).toBeDisabled();
  await connected.button('Close').click();
  await expect(connected.link).toHaveText(READY);
  expect((await kindsAfter(ptyBoard.bus, before)).filter((kind) => kind !== 'readBattery')).toEqual([]);
});

test('a slider moves the servo behind a real port, and the estimate follows', async ({
  connected,
  ptyBoard,
}) => {
  await connected.slider(2).press('PageUp');
  await poll(() => lastTarget(ptyBoard.bus, 2)).toBe(1600);
  await expect(connected.estimate(2)).toHaveText('≈ 1600');
});

test('STOP goes out three times over a real port, and holds', async ({ connected, ptyBoard }) => {
  await connected.type(connected.target(1), 2000);
  await expect(connected.estimate(1)).toHaveText('≈ 2000');
  await connected.stop.click();
  await expect(connected.status).toContainText('Stop sent');
  await poll(async () => ofKind(await ptyBoard.bus(), 'stop').length).toBeGreaterThanOrEqual(3);
  expect(ofKind(await ptyBoard.bus(), 'move').at(-1)?.targets).toEqual([{ servo: 1, position: 2000 }]);
});

test('an adapter that goes away is reported as such @exhaustive', async ({ connected, ptyBoard }) => {
  await ptyBoard.unplug();
  await expect(connected.link).toHaveText(/^Lost/);
  await expect(connected.status).toContainText(/Check the robot’s cable|Plug the robot in|Another program/);
  await expect(connected.bar).toContainText(/Next try in \d+ s/);
});
