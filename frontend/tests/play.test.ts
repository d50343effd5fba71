// What a group becomes: on the board by compile, played from the page and by the board, recorded by hand, begun from an example.

import { ofKind } from '../../e2e/fixtures/bus.ts';
import * as group from '../../e2e/fixtures/group.ts';
import * as library from '../../e2e/fixtures/library.ts';
import * as notes from '../../e2e/fixtures/notes.ts';
import * as timeline from '../../e2e/fixtures/timeline.ts';
import { expect, here, poll, test } from './harness/test.ts';
import { advance } from './harness/time.ts';

const { captureGroup, downloadGroup } = here(group);
const { libraryOf } = here(library);
const { noteTexts } = here(notes);
const { timelineOf } = here(timeline);

test('the board gets a group before it runs it, not a second time, and in place of another one when the person agrees', async ({
  dashboard,
  robot,
  page,
}) => {
  await captureGroup(dashboard, [1000, 1400], 400);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1400');
  const said = await noteTexts(dashboard.status);
  await dashboard.button('Run on board').click();
  await poll(said).toContainEqual(expect.stringContaining('Running slot 21, once'));
  await expect(dashboard.status).toHaveText('Idle');
  expect(ofKind(await robot.bus(), 'download')).toHaveLength(2);
  await dashboard.button('Run on board').click();
  await poll(async () => ofKind(await robot.bus(), 'run').length).toBe(2);
  expect(ofKind(await robot.bus(), 'download')).toHaveLength(2);
  await expect(dashboard.status).toHaveText('Idle');

  const library = libraryOf(page);
  await library.show();
  await library.button('New group').click();
  await expect(dashboard.frames).toHaveCount(0);
  await library.call('Instead');
  await captureGroup(dashboard, [1400], 400);
  await dashboard.type(dashboard.slot, 21);
  const question = page.getByRole('alertdialog', { name: 'Slot 21 holds another group' });
  const answers = [
    { answer: 'Leave it as it is', downloads: 2, runs: 2 },
    { answer: 'Replace', downloads: 3, runs: 3 },
  ];
  for (const { answer, downloads, runs } of answers) {
    await dashboard.button('Run on board').click();
    await expect(question).toContainText('Instead');
    expect(ofKind(await robot.bus(), 'download')).toHaveLength(2);
    await question.getByRole('button', { name: answer }).click();
    await expect(question).toBeHidden();
    await poll(async () => ofKind(await robot.bus(), 'run').length).toBe(runs);
    expect(ofKind(await robot.bus(), 'download')).toHaveLength(downloads);
  }
});

test('the map of slots knows an older copy, compares it, and brings back what an erase took', async ({
  dashboard,
  robot,
  page,
}) => {
  await captureGroup(dashboard, [1000, 1400], 400);
  await downloadGroup(dashboard, 8, 1400);
  await dashboard.button('Slots').click();
  const dialog = page.getByRole('dialog', { name: 'Slots of the board' });
  const slot = (name: RegExp) => dialog.getByRole('option', { name });
  await expect(slot(/^Slot 8: New group/)).toHaveAccessibleName('Slot 8: New group. This group, up to date');
  await expect(dialog).toContainText('Played by circle of the wireless pad');
  await dialog.getByRole('button', { name: 'Close' }).click();

  await dashboard.type(dashboard.frameTime(2), 600);
  await dashboard.button('Slots').click();
  await expect(dialog.getByText('Older copy')).toBeVisible();
  await dialog.getByRole('button', { name: 'Compare' }).click();
  await expect(dialog).toContainText('Frame 2 is the first one that differs.');
  await slot(/^Slot 8:/).press('ArrowRight');
  await expect(slot(/^Slot 9:/)).toHaveAttribute('aria-selected', 'true');
  await dialog.getByRole('button', { name: 'Close' }).click();

  await dashboard.button('Erase everything').click();
  const asks = page.getByRole('alertdialog');
  await expect(asks).toContainText('Can be restored afterwards: 8 New group.');
  await asks.getByRole('button', { name: 'Erase every slot' }).click();
  await expect(dashboard.notices).toContainText('Every slot is empty.');
  await dashboard.button('Slots').click();
  await dialog.getByRole('button', { name: 'Restore all 1' }).click();
  await expect(slot(/^Slot 8: New group/)).toBeVisible();
  const frames = ofKind(await robot.bus(), 'download').slice(-2);
  expect(frames.map(({ slot: at, frame }) => [at, frame.durationMs])).toEqual([
    [8, 400],
    [8, 400],
  ]);
});

test('several groups of the library go to their slots with one progress', async ({
  dashboard,
  robot,
  page,
}) => {
  const library = libraryOf(page);
  await captureGroup(dashboard, [1000, 1400], 400);
  await library.call('Wave for six');
  await dashboard.type(dashboard.slot, 6);
  await dashboard.button('Remember slot and times').click();
  for (const name of ['Empty for nine', 'Bow for seven']) {
    await library.show();
    await library.button('New group').click();
    await library.call(name);
  }
  await captureGroup(dashboard, [1300], 400);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1300');

  await dashboard.button('Slots').click();
  const dialog = page.getByRole('dialog', { name: 'Slots of the board' });
  await dialog.getByRole('button', { name: 'Download several' }).click();
  const several = dialog.getByRole('region', { name: 'Download several groups' });
  const slotOf = (name: string) => several.getByRole('textbox', { name: `Slot for ${name}` });
  const all = several.getByRole('checkbox', { name: /^All \d+$/ });
  const choices = several.getByRole('list').getByRole('checkbox');
  const cannotGo = choices.and(page.getByRole('checkbox', { checked: false }));
  await expect(choices, 'the list is read, the group just made in it').toHaveCount(3);
  await all.click();
  await expect(several.getByRole('checkbox', { name: /^Bow for seven/ })).toBeChecked();
  await expect(all).toBeChecked();
  await expect(several.getByRole('checkbox', { name: /^Empty for nine/ })).not.toBeChecked();
  const empty = several.getByRole('listitem').filter({ hasText: 'Empty for nine' });
  await expect(empty).toContainText('It has no frame yet.');
  await page.setViewportSize({ width: 1440, height: 300 });
  const whyNot = empty.getByText('It has no frame yet.');
  await expect(whyNot, 'whole, also where the list is longer than its place').toBeVisible();
  await poll(async () => bottomOf(await whyNot.boundingBox()) <= bottomOf(await empty.boundingBox())).toBe(
    true,
  );
  await page.setViewportSize({ width: 1440, height: 900 });
  await expect(several.getByRole('status')).toContainText(`${await cannotGo.count()} group`);
  await expect(several.getByRole('button', { name: 'Download these' })).toBeEnabled();
  await all.click();
  await expect(choices.and(page.getByRole('checkbox', { checked: true }))).toHaveCount(0);
  // Its frames are read first, so the check comes a moment after the press.
  await several.getByRole('checkbox', { name: /^Wave for six/ }).click();
  await expect(slotOf('Wave for six')).toHaveValue('6');
  await several.getByRole('checkbox', { name: /^Bow for seven/ }).click();
  await expect(slotOf('Bow for seven')).toHaveValue('21');
  await dashboard.type(slotOf('Bow for seven'), 6);
  await expect(several).toContainText('Slot 6 is chosen twice.');
  await expect(several.getByRole('button', { name: 'Download these' })).toBeDisabled();
  await dashboard.type(slotOf('Bow for seven'), 7);
  await several.getByRole('button', { name: 'Download these' }).click();
  await expect(dialog.getByRole('option', { name: /^Slot 6: Wave for six/ })).toBeVisible();
  await expect(
    dialog.getByRole('option', { name: 'Slot 7: Bow for seven. This group, up to date' }),
  ).toBeVisible();
  const stored = ofKind(await robot.bus(), 'download');
  expect(stored.map(({ slot, frame }) => [slot, frame.targets[0]?.position])).toEqual([
    [6, 1000],
    [6, 1400],
    [7, 1300],
  ]);
  await expect(several.getByRole('button', { name: 'Download these' })).toBeEnabled();
  await dashboard.stop.click();
  await expect(several.getByRole('button', { name: 'Download these' })).toBeDisabled();
  await expect(several.getByRole('status')).toContainText('Stopped. Resume to move.');
});

test('what a hand did becomes keys: recorded on purpose, or taken after the fact', async ({
  dashboard,
  page,
}) => {
  await dashboard.type(dashboard.target(1), 1400);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1400');
  await dashboard.button('Record').click();
  await dashboard.type(dashboard.target(1), 1900);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1900');
  await dashboard.button(/^End recording/).click();
  const dialog = page.getByRole('dialog', { name: 'Recorded motion' });
  await expect(dialog).toContainText(/positions become \d+ keys/);
  await dialog.getByRole('button', { name: 'Make it the group' }).click();
  await expect(dashboard.frame(1)).toHaveAccessibleName('Frame 1, 1500 ms, moves servo 1');
  await expect(dashboard.field('Name of the group')).toHaveValue(/^Take \d\d:\d\d$/);
  const count = await dashboard.frames.count();

  await dashboard.frame(1).press('t');
  await dialog.getByRole('button', { name: 'Add to the end' }).click();
  await poll(() => dashboard.frames.count()).toBeGreaterThan(count);

  // The hand may be on something else: its motion is kept all the same.
  await page.getByRole('radio', { name: 'Poses', exact: true }).check();
  await dashboard.button('Capture pose').press('t');
  await dialog.getByRole('button', { name: 'Make it the group' }).click();
  await expect(page.getByRole('radio', { name: 'Action group', exact: true })).toBeChecked();
  await expect(dashboard.frame(1)).toBeVisible();
});

test('STOP ends what is recorded, and what was recorded until then becomes keys', async ({
  dashboard,
  page,
}) => {
  await dashboard.type(dashboard.target(1), 1000);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1000');
  await dashboard.button('Record').click();
  await dashboard.type(dashboard.target(1), 2000);
  await advance(500);
  await page.keyboard.press('Escape');
  await expect(dashboard.button(/^End recording/)).toHaveCount(0);
  const dialog = page.getByRole('dialog', { name: 'Recorded motion' });
  await expect(dialog).toContainText(/positions become \d+ keys/);
  await expect(dashboard.notices).toContainText('STOP ended the recording');
  await dialog.getByRole('button', { name: 'Make it the group' }).click();
  await expect(dashboard.button('Record')).toBeVisible();
  await expect(dashboard.resume).toBeVisible();
  await expect(dashboard.frame(1)).toHaveAccessibleName('Frame 1, 1500 ms, moves servo 1');
});

test('armed rows are recorded, each moved by itself, and no other', async ({ dashboard, page }) => {
  for (const row of ['Gripper', 'Elbow']) {
    await dashboard.button(`Row of ${row}`).click();
    await page.getByRole('menuitem', { name: 'Arm for recording' }).click();
  }
  await expect(page.getByRole('img', { name: 'armed for recording' })).toHaveCount(2);
  for (const servo of [1, 2, 4]) {
    await dashboard.type(dashboard.target(servo), 1400);
    await expect(dashboard.estimate(servo)).toHaveText('≈ 1400');
  }
  await dashboard.button('Record').click();
  for (const servo of [1, 2, 4]) {
    await dashboard.type(dashboard.target(servo), 1600);
    await expect(dashboard.estimate(servo)).toHaveText('≈ 1600');
  }
  await dashboard.button(/^End recording/).click();
  await page
    .getByRole('dialog', { name: 'Recorded motion' })
    .getByRole('button', { name: 'Make it the group' })
    .click();
  await expect(dashboard.frame(1)).toHaveAccessibleName(/, moves servos 1 and 4$/);
  await expect(dashboard.frames.getByRole('button', { name: /servos? .*\b2\b/ })).toHaveCount(0);
});

test('part of a recording goes in at the playhead, or over what its servos do there', async ({
  dashboard,
  page,
}) => {
  await captureGroup(dashboard, [1000, 1400], 1000);
  await dashboard.type(dashboard.target(1), 1500);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1500');
  await dashboard.button('Record').click();
  for (const position of [1900, 1300, 1700]) {
    await dashboard.type(dashboard.target(1), position);
    await expect(dashboard.estimate(1)).toHaveText(`≈ ${position}`);
  }
  await dashboard.button(/^End recording/).click();
  const dialog = page.getByRole('dialog', { name: 'Recorded motion' });
  const result = await dialog.getByRole('status').textContent();
  const begin = dialog.getByRole('slider', { name: 'Begin' });
  await begin.fill('1000');
  await expect(begin).toHaveAttribute('aria-valuetext', '1.0 sec');
  expect(await dialog.getByRole('status').textContent()).not.toBe(result);
  const count = await dashboard.frames.count();
  await dialog.getByRole('button', { name: 'Insert at the playhead' }).click();
  await poll(() => dashboard.frames.count()).toBeGreaterThan(count);
  await expect(dashboard.button('Undo: insert recorded motion')).toBeVisible();

  await dashboard.button('Undo: insert recorded motion').click();
  await expect(dashboard.frames).toHaveCount(count);
  await dashboard.frame(1).press('t');
  await dialog.getByRole('button', { name: 'Record over' }).click();
  await dashboard.button('Undo: record over').click();
  await expect(dashboard.frames).toHaveCount(count);
});

test('on a phone a recording goes on while the sliders are in front', async ({ dashboard, page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  const tab = (name: string) => page.getByRole('tab', { name }).click();
  await tab('Drive');
  await dashboard.type(dashboard.target(1), 1400);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1400');
  await tab('Animate');
  await dashboard.button('Record').click();
  await tab('Drive');
  await dashboard.type(dashboard.target(1), 1900);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1900');
  await tab('Animate');
  await dashboard.button(/^End recording/).click();
  const dialog = page.getByRole('dialog', { name: 'Recorded motion' });
  await expect(dialog).toContainText(/positions become \d+ keys/);
  await dialog.getByRole('button', { name: 'Make it the group' }).click();
  await expect(dashboard.frame(1)).toHaveAccessibleName('Frame 1, 1500 ms, moves servo 1');
});

test('what begins and ends moves nothing, and keeps the focus', async ({ dashboard, page }) => {
  await captureGroup(dashboard, [1000, 1400], 400);
  const steady = [dashboard.frame(1), dashboard.button('Run on board'), dashboard.button('Frame forward')];
  const places = () => Promise.all(steady.map((one) => one.boundingBox()));
  const before = await places();
  for (const [begins, ends] of [
    [/^Play\b/, 'Pause'],
    ['Preview', 'Pause'],
    ['Record', /^End recording/],
  ] as const) {
    await dashboard.button(begins).focus();
    await page.keyboard.press('Enter');
    await expect(dashboard.button(ends)).toBeFocused();
    expect(await places()).toEqual(before);
    await page.keyboard.press('Enter');
    await expect(dashboard.button(begins)).toBeFocused();
  }
});

test('the robot follows the playhead step by step, by button and by key, and no longer after STOP', async ({
  dashboard,
  page,
  robot,
}) => {
  await captureGroup(dashboard, [1000, 1400], 400);
  const follows = page.getByRole('switch', { name: 'Robot follows' });
  await follows.check();
  await dashboard.button('Frame back').click();
  await expect(dashboard.estimate(1)).toHaveText('≈ 1000');
  await timelineOf(page).grid.focus();
  await page.keyboard.press('.');
  await expect(dashboard.estimate(1)).toHaveText('≈ 1400');
  // Each in the time that the group has for it, and not as fast as the servo can.
  expect(ofKind(await robot.bus(), 'move').at(-1)?.durationMs).toBe(400);
  await dashboard.type(dashboard.frameTime(1), 500);
  await page.keyboard.press('Escape');
  await expect(follows).not.toBeChecked();
  await expect(follows).toBeDisabled();
});

const bottomOf = ({ y, height }: { readonly y: number; readonly height: number }): number => y + height;
