// A real port with something else behind it than a board that answers at once: a program of another speed, a LeArm in its other mode.

import { lastTarget, ofKind } from '../fixtures/bus.ts';
import { READY } from '../fixtures/dashboard.ts';
import { USB_ADAPTER } from '../fixtures/mockDevice.ts';
import { PRINTING } from '../fixtures/ptyBoard.ts';
import { testOn } from '../fixtures/realDevice.ts';
import { expect, poll } from '../fixtures/test.ts';

/** It has the time to start, and each question its own. */
const ASKED = { timeout: 15_000 };

const test = testOn(USB_ADAPTER);

test.describe('a program that prints at another speed', () => {
  test.use({ ptyOptions: { baud: 115_200, program: PRINTING } });

  test('is heard where a person asks for it, and the port is open again @exhaustive', async ({
    open,
    page,
  }) => {
    const dashboard = await open(page);
    await dashboard.button('Connect').click();
    await dashboard.button(`Open ${USB_ADAPTER.label}`).click();
    const question = page.getByRole('region', { name: 'Which board is this?' });
    await expect(question).toContainText('Nothing answered', ASKED);
    await dashboard.link.click();
    const dialog = dashboard.connectDialog;
    await dialog.getByText('Something does not work?').click();
    await expect(dialog).toContainText('Nothing has arrived from the board');
    await dashboard.button('Listen at other speeds').click();
    await expect(dialog.getByRole('status')).toContainText('At 115200 baud text arrives');
    await dashboard.button('Close').click();
    await expect(dashboard.button('Query again')).toBeVisible(ASKED);
  });
});

test.describe('a LeArm AI that has just been switched on', () => {
  /** Its K1 key, after the page has asked and has read what to do. */
  const K1 = 'modeKey=14000';
  test.use({ boardSettings: { board: 'learm-esp32', faults: ['reboot=1', K1] } });

  test('is silent until K1 is pressed, then is driven @exhaustive', async ({ open, page, ptyBoard }) => {
    test.slow();
    const dashboard = await open(page);
    await dashboard.button('Connect').click();
    await dashboard.button(`Open ${USB_ADAPTER.label}`).click();
    const question = page.getByRole('region', { name: 'Which board is this?' });
    await expect(question).toContainText(/K1 .*once/, ASKED);
    await expect(async () => {
      await dashboard.button('Query again').click({ timeout: 1000 });
      await expect(question).toContainText('Firmware version', { timeout: 4000 });
    }).toPass({ timeout: 30_000 });
    await dashboard.takeFor('LeArm AI').click();
    await expect(dashboard.link).toHaveText(READY);
    await dashboard.type(dashboard.target(2), 1600);
    await poll(() => lastTarget(ptyBoard.bus, 2)).toBe(1600);
    await dashboard.stop.click();
    await expect(dashboard.status).toContainText('Stop sent');
    await poll(async () => ofKind(await ptyBoard.bus(), 'stop').length).toBeGreaterThanOrEqual(3);
  });
});
