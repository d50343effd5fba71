// What single boards can do more: where their servos stand, letting go of them, the speed of their groups. A real gateway, real
// serial devices; the oracle is what the board heard.

import type { ServoTarget } from '#shared/codec/commands.ts';
import { ofKind } from '../fixtures/bus.ts';
import { dashboardOf, READY } from '../fixtures/dashboard.ts';
import { expect, poll, test } from '../fixtures/test.ts';

const saidOf = ({ servo, position }: ServoTarget): string => `${servo} to ${position}`;

const SIX = [1, 2, 3, 4, 5, 6];

test.describe('an xArm', () => {
  test.use({ boardSettings: { board: 'xarm' } });

  test('says where its servos stand, and lets go of them after a warning @exhaustive', async ({
    page,
    ptyBoard,
    newGateway,
  }) => {
    const { url } = await newGateway({ serial: ptyBoard.device, board: 'xarm' });
    const dashboard = dashboardOf(page);
    await page.goto(url);
    await expect(dashboard.link).toHaveText(READY);
    await dashboard.button('Read positions').click();
    await expect(dashboard.servoRow(6)).toContainText(/≈ 400.*400.*ago/u);
    await expect(dashboard.target(6)).toHaveValue('400');
    await dashboard.slider(5).press('ArrowRight');
    await dashboard.target(6).press('ArrowUp');
    // A move may say again what the one before it said.
    const said = async () =>
      ofKind(await ptyBoard.bus(), 'move').flatMap(({ targets }) => targets.map(saidOf));
    await poll(async () => [...new Set(await said())]).toEqual(['5 to 401', '6 to 401']);
    await dashboard.type(dashboard.target(1), 500);
    await expect(dashboard.estimate(1)).toHaveText('≈ 500');

    await dashboard.button('Release').click();
    const warning = page.getByRole('alertdialog', { name: 'Release every servo?' });
    await expect(warning).toContainText('The arm drops. Hold it.');
    await warning.getByRole('button', { name: 'Keep holding' }).click();
    await dashboard.button('Release').click();
    await warning.getByRole('button', { name: 'Release every servo' }).click();
    await expect(dashboard.servoRow(6)).not.toContainText('40');
    await poll(async () => ofKind(await ptyBoard.bus(), 'release')).toEqual([
      { kind: 'release', servos: SIX },
    ]);
    expect(ofKind(await ptyBoard.bus(), 'readPositions')).toContainEqual({
      kind: 'readPositions',
      servos: SIX,
    });

    await dashboard.stop.click();
    await expect(dashboard.resume).toBeVisible();
    await expect(dashboard.button('Release')).toBeDisabled();
    await dashboard.button('Read positions').click();
    await expect(dashboard.servoRow(1)).toContainText(/500.*ago/u);
  });
});

test.describe('an LSC-6', () => {
  test.use({ boardSettings: { board: 'lsc-6' } });

  test('plays a group, then every group, at another speed; it has no servos to ask @exhaustive', async ({
    page,
    ptyBoard,
    newGateway,
  }) => {
    const { url } = await newGateway({ serial: ptyBoard.device, board: 'lsc-6' });
    const dashboard = dashboardOf(page);
    await page.goto(url);
    await expect(dashboard.link).toHaveText(READY);
    await expect(dashboard.button('Read positions')).toHaveCount(0);
    await dashboard.type(dashboard.slot, 8);
    await dashboard.type(dashboard.field('Group speed in percent'), 50);
    await dashboard.button('Set speed').click();
    await expect(dashboard.notices).toContainText('The speed 50 % was sent for slot 8');
    await page.getByRole('switch', { name: 'Every slot' }).press('Space');
    await dashboard.button('Set speed').click();
    await poll(async () => ofKind(await ptyBoard.bus(), 'setSpeed')).toEqual([
      { kind: 'setSpeed', slot: 8, percent: 50 },
      { kind: 'setSpeed', slot: null, percent: 50 },
    ]);
  });
});
