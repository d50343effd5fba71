// Nothing of HID is made up here but the chooser: a real Chromium, and a real gateway, open a hidraw node through their own code.
// Where umockdev is missing these are skipped, and the reason is reported.

import { lastTarget, ofKind } from '../fixtures/bus.ts';
import { dashboardOf, ONCE_BACK, READY } from '../fixtures/dashboard.ts';
import { BOARD_LABEL, BOARD_NAME, HID_BOARD } from '../fixtures/mockBoard.ts';
import { SILENT } from '../fixtures/ptyBoard.ts';
import { testOn } from '../fixtures/realDevice.ts';
import { expect, poll } from '../fixtures/test.ts';

const test = testOn(HID_BOARD);

test('a board on its own USB cable is driven, stopped, pulled and found again', async ({
  connected,
  ptyBoard,
  pull,
  plugIn,
}) => {
  await expect(connected.battery).toContainText('7.50 V');
  await connected.type(connected.target(1), 2000);
  await expect(connected.estimate(1)).toHaveText('≈ 2000');
  await connected.stop.click();
  await expect(connected.status).toContainText('Stop sent');
  await poll(async () => ofKind(await ptyBoard.bus(), 'stop').length).toBeGreaterThanOrEqual(3);
  await pull();
  await expect(connected.link).toHaveText(/^Lost/);
  await plugIn();
  await expect(connected.link).toHaveText(READY, ONCE_BACK);
  await expect(connected.status).toContainText('The link was restored; check the robot first');
});

test.describe('a board that is switched off', () => {
  test.use({ ptyOptions: { program: SILENT } });

  test('is said at once to be silent, with what to do @exhaustive', async ({ open, page }) => {
    const dashboard = await open(page);
    await dashboard.button('Connect').click();
    await dashboard.button(`Open ${BOARD_LABEL}`).click();
    await expect(page.getByRole('region', { name: 'Which board is this?' })).toContainText('switch it on');
    await dashboard.link.click();
    await dashboard.connectDialog.getByText('Something does not work?').click();
    await expect(dashboard.connectDialog).toContainText('Switch it on: the cable alone does not power it');
  });
});

test('a board that was chosen is opened without a chooser at the next visit @exhaustive', async ({
  connected,
  open,
  page,
}) => {
  await connected.link.click();
  await expect(connected.button(`${BOARD_LABEL} is open`)).toBeDisabled();
  const again = await open(page);
  await expect(again.link).toHaveText(READY);
});

test('a gateway drives a board on its own USB cable, and finds it again @exhaustive', async ({
  mockDevice,
  newGateway,
  ptyBoard,
  browser,
  pull,
  plugIn,
}) => {
  const gateway = await newGateway({ serial: 'hid', mockTree: mockDevice.tree });
  const page = await browser.newPage();
  await page.goto(gateway.url);
  const dashboard = dashboardOf(page);
  await expect(dashboard.link).toHaveText(READY);
  await dashboard.type(dashboard.target(2), 1600);
  await poll(() => lastTarget(ptyBoard.bus, 2)).toBe(1600);
  await dashboard.link.click();
  await expect(dashboard.button(`LOBOT, USB cable of the board (${BOARD_NAME}) is open`)).toBeDisabled();
  await dashboard.button('Close').click();
  await pull();
  await expect(dashboard.link).toHaveText(/^Lost/);
  await plugIn();
  await expect(dashboard.link).toHaveText(READY, ONCE_BACK);
  await page.close();
});
