// Nothing of HID is made up here but the chooser: a real Chromium, and a real gateway, open a hidraw node through their own code.
// Where umockdev is missing these are skipped, and the reason is told.

import { lastTarget, ofKind } from '../fixtures/bus.ts';
import { dashboardOf, ONCE_BACK, READY } from '../fixtures/dashboard.ts';
import { BOARD_LABEL, BOARD_NAME } from '../fixtures/mockBoard.ts';
import { expect, poll, test } from '../fixtures/realBoard.ts';

test('a board on its own USB cable is driven, stopped, pulled and found again', async ({
  openBoard,
  ptyBoard,
  pull,
  plugIn,
}) => {
  await expect(openBoard.battery).toContainText('7.50 V');
  await openBoard.type(openBoard.target(1), 2000);
  await expect(openBoard.estimate(1)).toHaveText('≈ 2000');
  await openBoard.stop.click();
  await expect(openBoard.status).toContainText('Stop sent');
  await poll(async () => ofKind(await ptyBoard.bus(), 'stop')).toHaveLength(3);
  await pull();
  await expect(openBoard.link).toHaveText(/^Lost/);
  await plugIn();
  await expect(openBoard.link).toHaveText(READY, ONCE_BACK);
  await expect(openBoard.status).toContainText('The link was restored; check the robot first');
});

test('a board that was chosen is opened without a chooser at the next visit @exhaustive', async ({
  openBoard,
  open,
  page,
}) => {
  await openBoard.link.click();
  await expect(openBoard.button(`${BOARD_LABEL} is open`)).toBeDisabled();
  const again = await open(page);
  await expect(again.link).toHaveText(READY);
});

test('a gateway drives a board on its own USB cable, and finds it again @exhaustive', async ({
  mockBoard,
  newGateway,
  ptyBoard,
  browser,
  pull,
  plugIn,
}) => {
  const gateway = await newGateway({ serial: 'hid', mockTree: mockBoard.tree });
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
