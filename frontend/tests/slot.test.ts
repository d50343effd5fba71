// The board's own memory: what a slot holds and runs, what takes its place, and what an erase takes.

import { kindsAfter, lastTarget, ofKind, STOPS_OF_AN_END } from '../../e2e/fixtures/bus.ts';
import * as group from '../../e2e/fixtures/group.ts';
import * as library from '../../e2e/fixtures/library.ts';
import * as notes from '../../e2e/fixtures/notes.ts';
import { SLOW_FLASH } from '../../e2e/fixtures/robot.ts';
import * as stopping from '../../e2e/fixtures/stopping.ts';
import { expect, here, poll, test } from './harness/test.ts';

const { captureGroup, downloadGroup } = here(group);
const { libraryOf } = here(library);
const { noteAttribute } = here(notes);
const { stopAndCheck } = here(stopping);

test('a group runs until it is ended after its frame in progress, one at a time', async ({
  dashboard,
  robot,
}) => {
  await captureGroup(dashboard, [1000, 1600], 200);
  await downloadGroup(dashboard, 1, 1600);
  await dashboard.untilStopped.check();
  await expect(dashboard.times).toBeDisabled();
  await dashboard.button('Run').click();
  await expect(dashboard.status).toHaveText('Running slot 1, until stopped: received by the board');
  expect(ofKind(await robot.bus(), 'run')).toEqual([{ kind: 'run', slot: 1, times: 0 }]);

  const beforeSecond = (await robot.bus()).length;
  await dashboard.button('Run').click();
  await poll(() => kindsAfter(robot.bus, beforeSecond)).toEqual([
    'stop',
    'move',
    'stop',
    'stop',
    'move',
    'run',
  ]);
  await expect(dashboard.status).toContainText('received by the board');

  const beforeEnd = (await robot.bus()).length;
  await dashboard.button('End group').click();
  await expect(dashboard.status).toHaveText('Idle');
  // Half a second behind a run, and never among its stops, the page asks for the battery.
  const kinds = async () => (await kindsAfter(robot.bus, beforeEnd)).join(' ');
  await poll(kinds).toMatch(new RegExp(`^stop( stop){${STOPS_OF_AN_END - 1}}( readBattery)*$`));
  await expect(dashboard.resume).toBeHidden();
});

test('a group without a slot of its own gets a free one, and another group is replaced only after a question', async ({
  dashboard,
  robot,
  page,
}) => {
  const library = libraryOf(page);
  const question = page.getByRole('alertdialog', { name: 'Slot 2 holds another group' });
  const stored = async () => ofKind(await robot.bus(), 'download').map(({ slot }) => slot);
  await captureGroup(dashboard, [1000], 200);
  await library.call('Bow in two');
  await downloadGroup(dashboard, 2, 1000);
  await library.show();
  await library.button('New group').click();
  await captureGroup(dashboard, [1300], 200);
  await library.call('Wave in none');
  await expect(dashboard.slot).toHaveValue('21');
  await expect(dashboard.estimate(1)).toHaveText('≈ 1300');

  await dashboard.type(dashboard.slot, 2);
  await expect(dashboard.boardBar).toContainText('Holds “Bow in two”');
  await dashboard.button('Download').click();
  await expect(question).toContainText('“Wave in none” replaces “Bow in two”');
  await question.getByRole('button', { name: 'Leave it as it is' }).click();
  await expect(question).toBeHidden();
  expect(await stored()).toEqual([2]);
  await dashboard.button('Download').click();
  await question.getByRole('button', { name: 'Use slot 21' }).click();
  await expect(dashboard.notices).toContainText('Slot 21 is downloaded.');
  await expect(dashboard.slot).toHaveValue('21');
  expect(await stored()).toEqual([2, 21]);

  await library.show();
  await library.open('Bow in two');
  await expect(dashboard.slot, 'where it is').toHaveValue('2');
  await expect(dashboard.boardBar).toContainText('Holds this group');
});

test.describe('on a board with slow flash', () => {
  test.override({ boardSettings: SLOW_FLASH });

  test('a download shows how far it is; cancelled, it leaves the slot broken, and that is not run', async ({
    dashboard,
    robot,
  }) => {
    await captureGroup(dashboard, [1000, 1010, 1020]);
    await dashboard.type(dashboard.slot, 7);
    await expect(dashboard.estimate(1)).toHaveText('≈ 1020');
    await dashboard.button('Download').click();
    await expect(dashboard.progress).toHaveAttribute('aria-valuetext', '0 of 3 frames');
    await expect(dashboard.status).toHaveText('Downloading to slot 7');
    await expect(dashboard.slider(1)).toHaveAttribute('aria-disabled', 'true');
    await dashboard.board.getByRole('button', { name: 'Cancel' }).click();

    await expect(dashboard.notices).toContainText(
      'Download cancelled. Slot 7 is broken until a whole group is downloaded.',
    );
    await expect(dashboard.board).toContainText('Its download did not finish.');
    await expect(dashboard.button('Run')).toBeDisabled();
    expect(ofKind(await robot.bus(), 'download')).toHaveLength(1);

    await dashboard.type(dashboard.slot, 8);
    await expect(dashboard.button('Run')).toBeEnabled();
    await dashboard.type(dashboard.slot, 7);
    await dashboard.button('Download').click();
    const shown = await noteAttribute(dashboard.progress, 'aria-valuetext');
    await expect(dashboard.button('Run')).toBeEnabled();
    await poll(shown).toContain('2 of 3 frames');
  });
});

test('erasing asks first and names what is lost', async ({ dashboard, robot, page }) => {
  const erase = dashboard.button('Erase everything');
  const dialog = page.getByRole('alertdialog', { name: 'Erase every slot of the board?' });
  await erase.click();
  await expect(dialog).toContainText('All 256 slots are emptied, including the manufacturer’s groups.');
  await dialog.getByRole('button', { name: 'Keep them' }).click();
  await expect(dialog).toBeHidden();
  expect(ofKind(await robot.bus(), 'erase')).toEqual([]);

  await erase.click();
  await dialog.getByRole('button', { name: 'Erase every slot' }).click();
  await expect(dashboard.notices).toContainText('Every slot is empty.');
  expect(ofKind(await robot.bus(), 'erase')).toHaveLength(1);
});

test('behind an erase a run runs nothing: a move is held by STOP, and nothing is said to move on', async ({
  dashboard,
  robot,
  page,
}) => {
  const slots = page.getByRole('dialog', { name: 'Slots of the board' });
  await captureGroup(dashboard, [1000], 200);
  await downloadGroup(dashboard, 21, 1000);
  await dashboard.button('Erase everything').click();
  await page.getByRole('alertdialog').getByRole('button', { name: 'Erase every slot' }).click();
  await expect(dashboard.boardBar).toContainText('Empty');
  await dashboard.button('Slots').click();
  for (const slot of [21, 77])
    await expect(
      slots.getByRole('option', { name: `Slot ${slot}: Empty since everything was erased` }),
    ).toBeVisible();
  await slots.getByRole('button', { name: 'Close' }).click();

  await dashboard.button('Run').click();
  await poll(async () => ofKind(await robot.bus(), 'run')).toEqual([{ kind: 'run', slot: 21, times: 1 }]);
  await page.getByRole('radio', { name: 'Fixed time' }).check();
  await dashboard.type(dashboard.field('Move time in milliseconds'), 10_000);
  await dashboard.type(dashboard.target(1), 2000);
  // Its first second has left.
  await poll(() => lastTarget(robot.bus, 1)).toBe(1100);
  await stopAndCheck(dashboard, robot.bus, () => dashboard.stop.click());
  const held = await lastTarget(robot.bus, 1);
  expect(held, 'where it is by then').toBeLessThan(1100);
  await expect(dashboard.estimate(1)).toHaveText(`≈ ${held}`);
  await expect(page.getByText(/may keep moving/)).toHaveCount(0);
});
