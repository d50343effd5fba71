// One robot, two screens: a viewer can stop it, and both see that it is stopped.

import { ofKind } from '../fixtures/bus.ts';
import { anotherBrowser, ready } from '../fixtures/dashboard.ts';
import { captureGroup, downloadGroup } from '../fixtures/group.ts';
import { libraryOf } from '../fixtures/library.ts';
import { expect, poll, test } from '../fixtures/test.ts';

test('a STOP on one screen stops the robot for both, and either may resume', async ({
  dashboard,
  robot,
  context,
}) => {
  await dashboard.type(dashboard.target(1), 2000);
  const page = await context.newPage();
  await robot.open(page);
  const other = await ready(page);
  await expect(other.target(1), 'whoever comes late learns of moves before').toHaveValue('2000');
  await expect(other.estimate(1)).toHaveText('≈ 2000');
  await dashboard.type(dashboard.target(1), 1800);
  await other.stop.click();
  await expect(dashboard.status).toContainText('Stopped at the robot’s computer');
  await expect(dashboard.slider(1)).toHaveAttribute('aria-disabled', 'true');
  await poll(async () => ofKind(await robot.bus(), 'stop').length).toBeGreaterThanOrEqual(3);
  await dashboard.resume.click();
  await expect(other.status).toHaveText('Idle');
  await expect(dashboard.status).toHaveText('Idle');
  await expect(other.notices).toContainText('Another window chose Resume');
});

test('what another browser stored in a slot is reported, and whether it is the open group', async ({
  dashboard,
  robot,
  browser,
}) => {
  await captureGroup(dashboard, [1000, 1400], 400);
  await libraryOf(dashboard.page).call('Bow of the other browser');
  await downloadGroup(dashboard, 0, 1400);
  const elsewhere = await anotherBrowser(browser, {
    locale: 'en-GB',
    viewport: dashboard.page.viewportSize(),
  });
  const page = await elsewhere.newPage();
  await robot.open(page);
  const other = await ready(page);
  await other.button('Slots').click();
  const slots = other.page.getByRole('dialog', { name: 'Slots of the board' });
  await slots
    .getByRole('option', { name: 'Slot 0: Bow of the other browser. Another group or version' })
    .click();
  await expect(slots.getByRole('region', { name: 'Slot 0' })).toContainText(
    /Bow of the other browser, 2 frames, 0.8 sec, downloaded by .+, .*\d\d:\d\d.*, version [0-9a-f]{6}/,
  );
  await slots.getByRole('button', { name: 'Compare' }).click();
  await expect(slots.getByRole('status')).toContainText('On the board 2 frames, 0.8 sec; here 0 frames');
  await slots.getByRole('button', { name: 'Download several' }).click();
  await slots.getByRole('checkbox', { name: /^Bow of the other browser/ }).click();
  const slotOfOwn = slots.getByRole('textbox', { name: 'Slot for Bow of the other browser' });
  await expect(slotOfOwn, 'where it is already, whoever put it there').toHaveValue('0');
  await slots.getByRole('button', { name: 'Close' }).click();
  await other.button('Details').click();
  const library = libraryOf(other.page);
  await library.show();
  await library.open('Bow of the other browser');
  await expect(other.board).toContainText('Holds this group, up to date.');
  await other.button('Take over').click();
  await other.button('Erase everything').click();
  const question = other.page.getByRole('alertdialog');
  await expect(question).toContainText('Can be restored afterwards: 0 Bow of the other browser.');
  await question.getByRole('button', { name: 'Erase every slot' }).click();
  await other.button('Slots').click();
  await slots.getByRole('button', { name: 'Restore all 1' }).click();
  await expect(slots.getByRole('option', { name: /^Slot 0: Bow of the other browser/ })).toBeVisible();
  expect(ofKind(await robot.bus(), 'download').map(({ slot, frame }) => [slot, frame.targets])).toEqual(
    [1000, 1400, 1000, 1400].map((position) => [0, [{ servo: 1, position }]]),
  );
  await expect(slots.getByRole('button', { name: /^Restore all/ })).toHaveCount(0);
  await dashboard.button('Slots').click();
  const slotsThere = dashboard.page.getByRole('dialog', { name: 'Slots of the board' });
  await expect(slotsThere.getByRole('option', { name: /^Slot 0: Bow of the other browser/ })).toBeVisible();
  await expect(slotsThere.getByRole('button', { name: /^Restore all/ })).toHaveCount(0);
  await elsewhere.close();
});
