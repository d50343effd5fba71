// Downloads over the gateway are its own work: they outlive the page that began them, and what breaks is broken for everybody.

import type { BrowserContext } from '@playwright/test';
import { ofKind } from '../fixtures/bus.ts';
import { anotherBrowser, dashboardOf, READY, type Dashboard } from '../fixtures/dashboard.ts';
import { captureGroup } from '../fixtures/group.ts';
import { libraryOf } from '../fixtures/library.ts';
import { SLOW_FLASH, type Robot } from '../fixtures/robot.ts';
import { expect, poll, test } from '../fixtures/test.ts';

/** The first word of the board is lost: all again, behind seven seconds in which much can be done. */
const LOST_WORD = { faults: ['slowErase=300', 'lostAck=1'] };

async function begins(dashboard: Dashboard, slot: number): Promise<void> {
  await captureGroup(dashboard, [1010, 1020, 1030]);
  await dashboard.type(dashboard.slot, slot);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1030');
  await dashboard.button('Download').click();
  await expect(dashboard.progress).toHaveAttribute('aria-valuetext', '0 of 3 frames');
}

/** Two groups of a frame each, as one job; `names` are new to the library. */
async function beginsTwo(dashboard: Dashboard, names: readonly string[], slots: readonly number[]) {
  const library = libraryOf(dashboard.page);
  for (const [index, name] of names.entries()) {
    if (index > 0) {
      await library.show();
      await library.button('New group').click();
      await expect(dashboard.frames).toHaveCount(0);
    }
    await captureGroup(dashboard, [1000 + 10 * index]);
    await library.call(name);
  }
  await expect(dashboard.estimate(1)).toHaveText(`≈ ${990 + 10 * names.length}`);
  await dashboard.button('Slots').click();
  await dashboard.button('Download several').click();
  const several = dashboard.page.getByRole('region', { name: 'Download several groups' });
  for (const [index, name] of names.entries()) {
    await several.getByRole('checkbox', { name: new RegExp(`^${name}`) }).click();
    await dashboard.type(several.getByRole('textbox', { name: `Slot for ${name}` }), slots[index]!);
  }
  await several.getByRole('button', { name: 'Download these' }).click();
  await expect(several.getByRole('progressbar')).toBeVisible();
}

async function joins(robot: Robot, context: BrowserContext): Promise<Dashboard> {
  const other = dashboardOf(await context.newPage());
  await robot.open(other.page);
  await expect(other.link).toHaveText(READY);
  return other;
}

const slotsHeard = async (robot: Robot): Promise<readonly number[]> =>
  ofKind(await robot.bus(), 'download').map(({ slot }) => slot);

const framesHeard = async (robot: Robot): Promise<readonly number[]> =>
  ofKind(await robot.bus(), 'download').map(({ frameIndex }) => frameIndex);

test.describe('on a board with slow flash', () => {
  test.use({ boardSettings: SLOW_FLASH });

  test('a download of several groups goes on when its tab is closed; opened again, the page finds them and runs one', async ({
    dashboard,
    robot,
    context,
  }) => {
    await beginsTwo(dashboard, ['Left alone first', 'Left alone second'], [20, 21]);
    await poll(() => slotsHeard(robot)).not.toEqual([]);
    await dashboard.page.close();
    await poll(() => slotsHeard(robot)).toEqual([20, 21]);

    const again = await joins(robot, context);
    await expect(again.notices).toContainText('2 groups are downloaded.');
    await again.type(again.slot, 21);
    await again.button('Run').click();
    await expect(again.status).toHaveText('Running slot 21, once: received by the board');
    await poll(async () => ofKind(await robot.bus(), 'run')).toEqual([{ kind: 'run', slot: 21, times: 1 }]);
    await expect(again.status).toHaveText('Idle');
  });
});

test.describe('on a board that seems to be silent', () => {
  test.use({ boardSettings: LOST_WORD });

  test('a page that is loaded again shows the download that is under way, and may call it off; another page sees its slot broken @exhaustive', async ({
    dashboard,
    robot,
    browser,
  }) => {
    await begins(dashboard, 22);
    await dashboard.page.reload();
    await expect(dashboard.status).toHaveText('Downloading to slot 22');
    await expect(dashboard.progress).toBeVisible();
    await expect(dashboard.slider(1)).toHaveAttribute('aria-disabled', 'true');
    await dashboard.board.getByRole('button', { name: 'Cancel' }).click();
    await expect(dashboard.status).toHaveText('Idle');
    await dashboard.type(dashboard.slot, 22);
    await expect(dashboard.board).toContainText('Its download did not finish.');
    expect(new Set(await framesHeard(robot))).toEqual(new Set([0]));

    // A whole copy was there before the next one that is called off.
    await dashboard.button('Download').click();
    await expect(dashboard.board).toContainText('Holds this group, up to date.');
    await dashboard.button('Download').click();
    await dashboard.board.getByRole('button', { name: 'Cancel' }).click();
    await expect(dashboard.board).toContainText('Its download did not finish.');
    const elsewhere = await anotherBrowser(browser);
    const other = await joins(robot, elsewhere);
    for (const each of [dashboard, other]) {
      await each.button('Slots').click();
      const slots = each.page.getByRole('dialog', { name: 'Slots of the board' });
      await slots.getByRole('option', { name: 'Slot 22: Broken: its download did not finish' }).click();
      const details = slots.getByRole('region', { name: 'Slot 22' });
      await expect(details).toContainText('Broken');
      await expect(details).not.toContainText(/downloaded (by|elsewhere)|library/i);
      await slots.getByRole('button', { name: 'Close' }).click();
    }
    await elsewhere.close();

    // Half a group is nothing that an erase takes.
    await dashboard.button('Erase everything').click();
    const question = dashboard.page.getByRole('alertdialog');
    await expect(question).toContainText('All 256 slots are emptied');
    await expect(question).not.toContainText('22');
    await question.getByRole('button', { name: 'Keep them' }).click();
  });

  test('a viewer sees it, STOP of anybody ends it, and nobody runs what is left', async ({
    dashboard,
    robot,
    browser,
  }) => {
    const elsewhere = await anotherBrowser(browser);
    const other = await joins(robot, elsewhere);
    await begins(dashboard, 23);
    await expect(other.status).toHaveText('Downloading to slot 23');
    await other.stop.click();
    await expect(dashboard.status).toContainText('Stopped');
    await poll(async () => ofKind(await robot.bus(), 'stop').length).toBeGreaterThanOrEqual(4);
    expect(new Set(await framesHeard(robot))).toEqual(new Set([0]));
    await dashboard.resume.click();
    for (const each of [dashboard, other]) {
      await each.type(each.slot, 23);
      await expect(each.board).toContainText('Its download did not finish.');
      await expect(each.button('Run')).toBeDisabled();
    }
    await elsewhere.close();
  });
});
