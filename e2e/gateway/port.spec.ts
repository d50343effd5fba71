// The gateway's port and the gateway itself come and go: the page says what to do, and needs no reload.

import { lastTarget } from '../fixtures/bus.ts';
import { dashboardOf, ONCE_BACK, READY } from '../fixtures/dashboard.ts';
import { captureGroup } from '../fixtures/group.ts';
import { PRINTING } from '../fixtures/ptyBoard.ts';
import { expect, poll, test } from '../fixtures/test.ts';

test('a port that is not there at the start says what to do, and is found when it comes', async ({
  page,
  ptyBoard,
  newGateway,
}) => {
  await ptyBoard.unplug();
  const gateway = await newGateway({ serial: ptyBoard.device });
  await page.goto(gateway.url);
  const dashboard = dashboardOf(page);
  await expect(dashboard.status).toContainText('The port was not found. Plug the robot in and switch it on');
  await expect(page.getByRole('heading', { name: 'No robot yet' })).toBeVisible();
  await ptyBoard.plugIn();
  await expect(dashboard.link).toHaveText(READY, ONCE_BACK);
  if (await dashboard.resume.isVisible()) await dashboard.resume.click();
  await dashboard.type(dashboard.target(1), 1234);
  await poll(() => lastTarget(ptyBoard.bus, 1)).toBe(1234);
});

test('a port that another program has names the program, until that ends @exhaustive', async ({
  page,
  ptyBoard,
  newGateway,
}) => {
  test.skip(process.platform !== 'linux', 'other systems do not tell');
  const other = await newGateway({ serial: ptyBoard.device });
  const gateway = await newGateway({ serial: ptyBoard.device });
  await page.goto(gateway.url);
  const dashboard = dashboardOf(page);
  const sentence = /This port is open in .*python\S* \(\d+\)\. Close it there/;
  await expect(dashboard.status).toContainText(sentence);
  await dashboard.link.click();
  await dashboard.connectDialog.getByText('Something does not work?').click();
  await expect(dashboard.connectDialog).toContainText(sentence);
  await dashboard.button('Close').click();
  await other.end();
  await expect(dashboard.link).toHaveText(READY, ONCE_BACK);
});

test.describe('a program that prints at another speed', () => {
  test.use({ ptyOptions: { baud: 115_200, program: PRINTING } });

  test('is heard at the gateway where its owner asks for it @exhaustive', async ({
    page,
    ptyBoard,
    newGateway,
  }) => {
    const gateway = await newGateway({ serial: ptyBoard.device, board: 'unknown' });
    await page.goto(gateway.url);
    const dashboard = dashboardOf(page);
    const question = page.getByRole('region', { name: 'Which board is this?' });
    await expect(question).toContainText('Nothing answered', { timeout: 15_000 });
    await dashboard.link.click();
    const dialog = dashboard.connectDialog;
    await dialog.getByText('Something does not work?').click();
    await dashboard.button('Listen at other speeds').click();
    await expect(dialog.getByRole('status')).toContainText('At 115200 baud text arrives');
    await dashboard.button('Close').click();
    await expect(dashboard.button('Query again')).toBeVisible({ timeout: 15_000 });
  });
});

test('a gateway without a port offers the ports it knows @exhaustive', async ({ page, newGateway }) => {
  const gateway = await newGateway();
  await page.goto(gateway.url);
  const dashboard = dashboardOf(page);
  await dashboard.button('Choose its port').click();
  await expect(dashboard.connectDialog.getByRole('group', { name: 'Gateway' })).toBeVisible();
  await expect(dashboard.connectDialog.getByRole('button', { name: 'Look again' })).toBeVisible();
});

test('a port in use is said to be, and not offered once more @exhaustive', async ({
  page,
  ptyBoard,
  newGateway,
}) => {
  const gateway = await newGateway({ serial: ptyBoard.device });
  await page.goto(gateway.url);
  const dashboard = dashboardOf(page);
  await expect(dashboard.link).toHaveText(READY);
  await dashboard.link.click();
  const ports = dashboard.connectDialog.getByRole('group', { name: 'Gateway' });
  await expect(ports.getByRole('button', { name: 'Port (board) is open' })).toBeDisabled();
  await expect(ports).toContainText('In use here. Choose Disconnect below to disconnect this page');
  await dashboard.button('Disconnect').click();
  await dashboard.link.click();
  await ports.getByRole('button', { name: 'Open Port (board)' }).click();
  await expect(dashboard.link).toHaveText(READY);
});

test.describe('when the gateway is killed', () => {
  test.use({ expectedComplaint: /WebSocket connection to .* failed|ERR_CONNECTION_REFUSED/ });

  test('the page says so, and goes on when it is there again, edits and all', async ({
    page,
    ptyBoard,
    newGateway,
  }) => {
    const first = await newGateway({ serial: ptyBoard.device });
    await page.goto(first.url);
    const dashboard = dashboardOf(page);
    await expect(dashboard.link).toHaveText(READY);
    // What works the group out beside the page comes from the gateway, too.
    const beside = page.waitForResponse(/compileWorker/);
    await captureGroup(dashboard, [1000, 1200]);
    await (await beside).finished();

    await first.end();
    await expect(dashboard.link).toHaveText(/^Lost/);
    await expect(dashboard.status).toContainText(
      'No gateway answers at this address. Start it with “npm start”',
    );
    await expect(dashboard.bar).toContainText(/Next try in \d+ s/);

    await newGateway({ serial: ptyBoard.device, port: Number(new URL(first.url).port) });
    await expect(dashboard.link).toHaveText(READY, ONCE_BACK);
    await expect(dashboard.frames).toHaveCount(2);
    await dashboard.type(dashboard.target(1), 1300);
    await poll(() => lastTarget(ptyBoard.bus, 1)).toBe(1300);
  });
});
