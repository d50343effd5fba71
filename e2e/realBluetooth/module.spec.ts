// Nothing of Web Bluetooth is made up here but the answer to the chooser, and nothing of the module but its radio: a real Chromium
// talks to BlueZ's interface. Where dbus-daemon is missing these are skipped, and the reason is reported.

import { lastTarget, ofKind } from '../fixtures/bus.ts';
import { ONCE_BACK, READY } from '../fixtures/dashboard.ts';
import { expect, poll, test } from '../fixtures/realBluetooth.ts';

test('a module is chosen, its board moves, tells its battery and stops', async ({
  openModule,
  bluetoothBoard,
}) => {
  await openModule.slider(2).press('PageUp');
  await poll(() => lastTarget(bluetoothBoard.bus, 2)).toBe(1600);
  await expect(openModule.battery).toContainText('7.50 V');
  await openModule.type(openModule.target(1), 2000);
  await expect(openModule.estimate(1)).toHaveText('≈ 2000');
  await openModule.stop.click();
  await expect(openModule.status).toContainText('Stop sent');
  await poll(async () => ofKind(await bluetoothBoard.bus(), 'stop').length).toBeGreaterThanOrEqual(3);
  expect(ofKind(await bluetoothBoard.bus(), 'move').at(-1)?.targets).toContainEqual({
    servo: 1,
    position: 2000,
  });
});

test('a link that breaks is reported at once, and comes back with a stop @exhaustive', async ({
  openModule,
  bluetoothBoard,
}) => {
  bluetoothBoard.say('drop');
  await expect(openModule.link).toHaveText(/^Lost/);
  await expect(openModule.link).toHaveText(READY, ONCE_BACK);
  await expect(openModule.status).toContainText('The link was restored; check the robot first');
  expect(ofKind(await bluetoothBoard.bus(), 'stop').length).toBeGreaterThan(0);
});

test('a robot that is switched off and on is found again @exhaustive', async ({
  openModule,
  bluetoothBoard,
}) => {
  bluetoothBoard.say('off');
  await expect(openModule.link).toHaveText(/^Lost/);
  await expect(openModule.status).toContainText('Bluetooth module does not answer', ONCE_BACK);
  bluetoothBoard.say('on');
  await expect(openModule.link).toHaveText(READY, ONCE_BACK);
});

test('a group is downloaded over Bluetooth and run @exhaustive', async ({ openModule, bluetoothBoard }) => {
  await openModule.slider(1).press('PageUp');
  await expect(openModule.estimate(1)).toHaveText('≈ 1600');
  await openModule.capture.click();
  await openModule.button('Download').click();
  await poll(async () => ofKind(await bluetoothBoard.bus(), 'download').length).toBeGreaterThan(0);
  await expect(openModule.button('Run')).toBeEnabled();
  await openModule.button('Run').click();
  await poll(async () => ofKind(await bluetoothBoard.bus(), 'run').length).toBe(1);
});
