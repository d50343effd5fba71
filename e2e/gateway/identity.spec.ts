// Boards nobody knows, and boards that are not what they were: what a person can tell from the page alone. A real gateway that
// was reported no board, real serial devices.

import type { BoardSettings } from '../fixtures/robot.ts';
import { expect, poll, test } from '../fixtures/test.ts';
import { dashboardOf, READY } from '../fixtures/dashboard.ts';

const HARMLESS = ['stop', 'readBattery', 'readVersion', 'readPositions'];

test.describe('a bus servo board', () => {
  test.use({ boardSettings: { board: 'xarm' } });

  test('is asked, chosen, named, and known again on every screen', async ({
    page,
    ptyBoard,
    newGateway,
    context,
  }) => {
    const { url } = await newGateway({ serial: ptyBoard.device, board: 'unknown' });
    const dashboard = dashboardOf(page);
    await page.goto(url);
    await expect(page.getByRole('region', { name: 'Which board is this?' })).toContainText(
      'Positions of its servos',
    );
    await expect(dashboard.stop).toBeEnabled();
    await dashboard.takeFor('xArm').click();
    await expect(dashboard.slider(6)).toBeEnabled();
    const heard = await ptyBoard.bus();
    expect(HARMLESS).toEqual(expect.arrayContaining(heard.map(({ command }) => command.kind)));

    await dashboard.link.click();
    await page.getByRole('textbox', { name: 'Name of this board' }).fill('Desk arm');
    await page.keyboard.press('Enter');
    await page.reload();
    await expect(dashboard.bar).toContainText('Desk arm');
    await dashboard.type(dashboard.target(2), 480);
    await poll(() => ptyBoard.bus().then((all) => all.at(-1)?.command.kind)).toBe('move');

    const second = await context.newPage();
    await second.goto(url);
    await expect(dashboardOf(second).link).toContainText('Ready');
    await expect(dashboardOf(second).bar).toContainText('Desk arm');
    await expect(dashboardOf(second).slider(6)).toHaveAttribute('max', '1000');
  });
});

interface Trouble {
  readonly trouble: string;
  readonly settings: BoardSettings;
  readonly says: RegExp;
}

const TROUBLES: readonly Trouble[] = [
  {
    trouble: 'a board that is switched off',
    settings: { board: 'lsc-16', faults: ['brownOut=0@600000'] },
    says: /Nothing answered.*off, not wired/,
  },
  { trouble: 'a looped line', settings: { faults: ['loopback'] }, says: /returns everything.*RX to TX/ },
  {
    trouble: 'a line that damages bytes',
    settings: { board: 'lsc-16', faults: ['flippedByte=0.4'] },
    says: /Something sends data, but not packets/,
  },
];

for (const { trouble, settings, says } of TROUBLES) {
  test.describe(trouble, () => {
    test.use({ boardSettings: settings });

    test('is reported in words that say what to do @exhaustive', async ({ page, ptyBoard, newGateway }) => {
      const { url } = await newGateway({ serial: ptyBoard.device, board: 'unknown' });
      await page.goto(url);
      await expect(page.getByRole('region', { name: 'Which board is this?' })).toContainText(says, {
        timeout: 15_000,
      });
    });
  });
}

test.describe('another board under the name of a known one', () => {
  test.use({ boardSettings: { board: 'learm-esp32' } });

  test('is not driven as the one before @exhaustive', async ({ page, ptyBoard, newGateway }) => {
    const { url } = await newGateway({ serial: ptyBoard.device, board: 'lsc-6' });
    await page.goto(url);
    const question = page.getByRole('region', { name: 'A different board answers' });
    await expect(question).toContainText('Firmware version');
    await dashboardOf(page).takeFor('LeArm AI').click();
    await expect(dashboardOf(page).slider(1)).toBeEnabled();
  });
});

test.describe('a board that falls silent', () => {
  test.use({ boardSettings: { board: 'lsc-6', faults: ['brownOut=5000@14000'] } });

  test('is called silent, then comes back latched @exhaustive', async ({ page, ptyBoard, newGateway }) => {
    const { url } = await newGateway({ serial: ptyBoard.device, board: 'lsc-6' });
    const dashboard = dashboardOf(page);
    await page.goto(url);
    await expect(dashboard.link).toHaveText(/^No answer/, { timeout: 20_000 });
    await expect(dashboard.status).toContainText('Switch it on');
    await expect(dashboard.link).toHaveText(READY, { timeout: 20_000 });
    await expect(dashboard.resume).toBeVisible();
  });
});
