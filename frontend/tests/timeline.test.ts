// Working on keys over time: by mouse, by keyboard alone, by touch.

import { ofKind } from '../../e2e/fixtures/bus.ts';
import * as e2e from '../../e2e/fixtures/timeline.ts';
import { expect, here, test } from './harness/test.ts';

const keepGroup = here(e2e.keepGroup);
const timelineOf = here(e2e.timelineOf);

/** Of the tracks, where the ruler and the heads of the frames are. */
const RULER_Y = 11;
const HEADS_Y = 33;

test.beforeEach(async ({ page }) => {
  await keepGroup(page);
});

test('on a usual laptop its tools stand in one row, and six rows need no scroll bar', async ({
  dashboard,
  page,
}) => {
  await page.setViewportSize({ width: 1366, height: 768 });
  const { grid, tools } = timelineOf(page);
  const first = await tools.getByRole('combobox', { name: 'Easing' }).boundingBox();
  const last = await tools.getByRole('button', { name: 'Tall rows' }).boundingBox();
  expect(Math.abs(first.y - last.y)).toBeLessThan(8);
  await page.setViewportSize({ width: 1000, height: 1000 });
  await expect(dashboard.frames).toHaveCount(3);
  const hiddenPx = await grid.evaluate((tracks) => {
    let area: Element | null = tracks;
    while (area !== null && getComputedStyle(area).overflowY !== 'auto') area = area.parentElement;
    return area === null ? NaN : area.scrollHeight - area.clientHeight;
  });
  expect(hiddenPx).toBe(0);
});

test('a key is dragged in time and value, in one step, and moves no robot', async ({
  dashboard,
  page,
  robot,
}) => {
  const timeline = timelineOf(page);
  await expect(timeline.key('Gripper, 1.00 s, 1200 µs, linear')).toBeVisible();
  const before = ofKind(await robot.bus(), 'move').length;
  const alone = await timeline.middleOf(timeline.key('Gripper, 1.00 s, 1200 µs, linear'));
  const next = await timeline.middleOf(timeline.key('Gripper, 1.50 s, 1400 µs, linear'));
  await timeline.drag('Gripper, 1.00 s, 1200 µs, linear', (next.x - alone.x) / 2, -45);
  await page.mouse.up();
  const moved = timeline.grid.getByRole('gridcell', { name: /^Gripper, 1\.2\d s, 13\d\d µs, linear$/ });
  await expect(moved).toHaveAttribute('aria-selected', 'true');
  await expect(timeline.key('Elbow, 1.00 s, 1500 µs, linear')).toBeVisible();
  await expect(dashboard.frames).toHaveCount(4);
  await dashboard.button('Undo: move keys').click();
  await expect(timeline.key('Gripper, 1.00 s, 1200 µs, linear')).toBeVisible();
  await expect(dashboard.frames).toHaveCount(3);
  expect(ofKind(await robot.bus(), 'move')).toHaveLength(before);
});

test('Escape calls a drag off, and stops the robot', async ({ dashboard, page }) => {
  const timeline = timelineOf(page);
  await timeline.drag('Gripper, 1.00 s, 1200 µs, linear', 40, 0);
  await expect(timeline.key('Gripper, 1.00 s, 1200 µs, linear')).toBeHidden();
  await page.keyboard.press('Escape');
  await expect(timeline.key('Gripper, 1.00 s, 1200 µs, linear')).toBeVisible();
  await expect(dashboard.resume).toBeVisible();
  await page.mouse.up();
  await expect(dashboard.button('Undo')).toBeDisabled();
});

test('the other button calls a drag off, and Ctrl copies what is dragged', async ({ dashboard, page }) => {
  const timeline = timelineOf(page);
  const second = timeline.key('Gripper, 1.00 s, 1200 µs, linear');
  await timeline.drag('Gripper, 1.00 s, 1200 µs, linear', 60, 0);
  await expect(second).toBeHidden();
  await page.mouse.down({ button: 'right' });
  await page.mouse.up({ button: 'right' });
  await expect(second).toBeVisible();
  await page.mouse.up();
  await expect(page.getByRole('menu')).toBeHidden();
  await expect(dashboard.status).toHaveText('Idle');
  await page.keyboard.down('Control');
  await timeline.drag('Gripper, 1.00 s, 1200 µs, linear', 60, 0);
  await page.mouse.up();
  await page.keyboard.up('Control');
  await expect(dashboard.button('Undo: duplicate keys')).toBeVisible();
  await expect(second).toBeVisible();
});

test('clicks, boxes, rows and frames select, and the strip is in step', async ({ dashboard, page }) => {
  const timeline = timelineOf(page);
  await timeline.click('Gripper, 0.50 s, 1000 µs, linear');
  await timeline.click('Elbow, 1.50 s, 1500 µs, linear', ['Control']);
  // The row of all servos says "selected" only where all of a frame is.
  await expect(timeline.selected).toHaveCount(2);
  await timeline.click('Gripper, 0.50 s, 1000 µs, linear');
  await expect(timeline.selected).toHaveCount(1);
  await timeline.click('Elbow, 1.00 s, 1500 µs, linear', ['Shift']);
  await expect(timeline.selected).toHaveCount(6);
  await dashboard.button('Select the keys of Gripper').click();
  await expect(timeline.selected).toHaveCount(3);
  await page.keyboard.press('Delete');
  await expect(timeline.key('Gripper, 0.50 s, 1000 µs, linear')).toBeHidden();
  await dashboard.button('Undo: delete 3 keys').click();
  await dashboard.frame(2).click();
  await expect(timeline.key('All servos, frame 2, 1.00 s, 2 keys')).toHaveAttribute('aria-selected', 'true');
  await timeline.click('All servos, frame 3, 1.50 s, 2 keys');
  await expect(dashboard.frame(3)).toHaveAttribute('aria-pressed', 'true');
  await dashboard.frame(2).click({ modifiers: ['Shift'] });
  await expect(dashboard.frame(3)).toHaveAttribute('aria-pressed', 'true');
  await expect(timeline.key('All servos, frame 2, 1.00 s, 2 keys')).toHaveAttribute('aria-selected', 'true');
  await page.keyboard.press('Delete');
  await expect(dashboard.frames).toHaveCount(1);
  await expect(dashboard.frame(1)).toBeFocused();
  await dashboard.button('Undo: delete 2 frames').click();
  await expect(dashboard.frames).toHaveCount(3);
});

test('a second click on a key opens its number in place', async ({ page, dashboard }) => {
  const timeline = timelineOf(page);
  await timeline.click('Gripper, 1.00 s, 1200 µs, linear');
  await timeline.click('Gripper, 1.00 s, 1200 µs, linear');
  const field = page.getByRole('textbox', { name: 'Position of the selected keys' });
  await expect(field).toHaveValue('1200');
  await field.fill('2600');
  await field.press('Enter');
  await expect(dashboard.notices).toContainText('2600 is out of range; it takes 500 to 2500.');
  await timeline.grid.press('F2');
  await field.fill('1720');
  await field.press('Enter');
  await expect(timeline.key('Gripper, 1.00 s, 1720 µs, linear')).toBeVisible();
  await expect(timeline.grid).toBeFocused();
});

test('until a number is typed in its field, what writes none is meant for the keys', async ({
  page,
  dashboard,
}) => {
  const timeline = timelineOf(page);
  const { keyboard } = page;
  const field = page.getByRole('textbox', { name: 'Position of the selected keys' });
  const name = 'Gripper, 1.00 s, 1200 µs, linear';
  const clickTwice = async (): Promise<void> => {
    await timeline.click('Elbow, 1.50 s, 1500 µs, linear');
    await timeline.click(name);
    await timeline.click(name);
    await expect(field).toBeFocused();
  };
  await clickTwice();
  await keyboard.press('ArrowRight');
  await expect(timeline.key('Gripper, 1.02 s, 1200 µs, linear')).toHaveAttribute('aria-selected', 'true');
  await expect(timeline.grid).toBeFocused();
  await keyboard.press('ControlOrMeta+z');
  await clickTwice();
  await keyboard.press('ControlOrMeta+x');
  await expect(timeline.key(name)).toBeHidden();
  await keyboard.press('Home');
  await keyboard.press('ControlOrMeta+v');
  await expect(timeline.key('Gripper, 0.00 s, 1200 µs, linear')).toBeVisible();
  await dashboard.button('Undo: paste keys').click();
  await dashboard.button('Undo: cut 1 key').click();
  await clickTwice();
  await keyboard.press('Delete');
  await expect(timeline.key(name)).toBeHidden();
  await keyboard.press('ControlOrMeta+z');
  await clickTwice();
  // A caret is set: the field is written in from here on.
  await keyboard.press('End');
  await keyboard.press('Backspace');
  await keyboard.press('ArrowLeft');
  await keyboard.type('5');
  await keyboard.press('Enter');
  await expect(timeline.key('Gripper, 1.00 s, 1250 µs, linear')).toBeVisible();
});

test('a field that is left without a number typed in it does nothing', async ({ page, dashboard }) => {
  const timeline = timelineOf(page);
  const { keyboard } = page;
  const time = page.getByRole('textbox', { name: 'Time to insert at the playhead in milliseconds' });
  await timeline.grid.focus();
  await keyboard.press('i');
  await expect(time).toBeFocused();
  await timeline.click('Elbow, 1.50 s, 1500 µs, linear');
  await expect(time).toBeHidden();
  await expect(dashboard.button('Undo')).toBeDisabled();
  await keyboard.press('Home');
  await keyboard.press('i');
  await keyboard.press('Enter');
  await expect(timeline.key('Elbow, 2.00 s, 1500 µs, linear')).toBeVisible();
});

test('everything is done by keyboard alone', async ({ page, dashboard }) => {
  const timeline = timelineOf(page);
  const { keyboard } = page;
  await timeline.grid.focus();
  await keyboard.press('ArrowDown');
  await keyboard.press('Control+ArrowRight');
  await expect(timeline.selected).toHaveAccessibleName('Gripper, 1.00 s, 1200 µs, linear');
  await keyboard.press('ArrowRight');
  await keyboard.press('Shift+ArrowUp');
  await expect(timeline.key('Gripper, 1.02 s, 1210 µs, linear')).toHaveAttribute('aria-selected', 'true');
  await keyboard.press('Control+Shift+a');
  await keyboard.press('Home');
  await keyboard.press('.');
  await keyboard.press('.');
  await keyboard.press('Enter');
  await expect(timeline.key('Gripper, 1.00 s, 1202 µs, linear')).toBeVisible();
  await keyboard.press('Delete');
  await expect(timeline.key('Gripper, 1.00 s, 1202 µs, linear')).toBeHidden();
  await keyboard.press('Control+a');
  await keyboard.press('Shift+F10');
  const easing = page.getByRole('menuitem', { name: 'Easing' });
  await expect(page.getByRole('menuitem', { name: 'Set key' })).toBeFocused();
  await keyboard.type('ea');
  await expect(easing).toBeFocused();
  await easing.press('ArrowRight');
  await page.getByRole('menuitem', { name: 'hold', exact: true }).press('Enter');
  await expect(timeline.key('Elbow, 1.50 s, 1500 µs, hold')).toBeVisible();
  await expect(dashboard.button('Undo: hold')).toBeEnabled();
  await expect(page.getByRole('menu')).toBeHidden();
  await expect(timeline.grid).toBeFocused();

  await keyboard.press('Shift+F10');
  await page.getByRole('menuitem', { name: 'Set marker' }).press('Enter');
  await expect(page.getByRole('textbox', { name: 'Text of the marker' })).toBeFocused();
  await keyboard.type('Bow');
  await keyboard.press('Enter');
  await keyboard.press('Shift+m');
  await keyboard.press('ArrowRight');
  await expect(timeline.region).toContainText('Bow, 1.02 s.');
  await keyboard.press('Delete');
  await expect(dashboard.button('Undo: delete marker')).toBeEnabled();
});

test('keys are copied to the clipboard of the system and come back at the playhead', async ({
  page,
  dashboard,
}) => {
  await expect(dashboard.frames).toHaveCount(3);
  const timeline = timelineOf(page);
  await timeline.click('Gripper, 1.50 s, 1400 µs, linear');
  await page.keyboard.press('Control+c');
  await page.keyboard.press('Home');
  await page.keyboard.press('Control+v');
  await expect(timeline.key('Gripper, 0.00 s, 1400 µs, linear')).toHaveAttribute('aria-selected', 'true');
  await page.keyboard.press('Control+x');
  await expect(timeline.key('Gripper, 0.00 s, 1400 µs, linear')).toBeHidden();
});

test('a second press in the same place asks for a marker’s text, and for a frame’s note', async ({
  page,
  dashboard,
}) => {
  await expect(dashboard.frames).toHaveCount(3);
  const timeline = timelineOf(page);
  await timeline.click('All servos, frame 2, 1.00 s, 2 keys');
  await page.keyboard.press('m');
  await page.keyboard.type('Bow');
  await page.keyboard.press('Enter');
  const first = await timeline.middleOf(timeline.key('All servos, frame 1, 0.50 s, 2 keys'));
  const second = await timeline.middleOf(timeline.key('All servos, frame 2, 1.00 s, 2 keys'));
  const beginX = 2 * first.x - second.x;
  const top = (await timeline.grid.boundingBox()).y;
  await page.mouse.dblclick(beginX, top + RULER_Y);
  const text = page.getByRole('textbox', { name: 'Text of the marker' });
  await expect(text).toHaveValue('Bow');
  await text.fill('Deep bow');
  await text.press('Enter');
  await page.mouse.dblclick(beginX, top + RULER_Y);
  await expect(text).toHaveValue('Deep bow');
  await text.press('Enter');
  await page.mouse.dblclick(second.x - 30, top + HEADS_Y);
  const note = page.getByRole('textbox', { name: 'Note on the frame' });
  await note.fill('Slowly');
  await note.press('Enter');
  await expect(page.getByRole('button', { name: /^Frame 2, .*Slowly$/ })).toBeVisible();
});

test('the menu on a frame is about its keys', async ({ page, dashboard }) => {
  await expect(dashboard.frames).toHaveCount(3);
  const timeline = timelineOf(page);
  const second = await timeline.middleOf(timeline.key('All servos, frame 2, 1.00 s, 2 keys'));
  const top = (await timeline.grid.boundingBox()).y;
  await page.mouse.click(second.x - 30, top + HEADS_Y, { button: 'right' });
  await page.getByRole('menuitem', { name: 'Delete keys' }).click();
  await expect(timeline.key('Gripper, 1.00 s, 1200 µs, linear')).toBeHidden();
  await expect(dashboard.button('Undo: delete 2 keys')).toBeVisible();
});

test('a box that is drawn past the lowest row in sight goes on through the rows', async ({
  page,
  dashboard,
}) => {
  await expect(dashboard.frames).toHaveCount(3);
  const timeline = timelineOf(page);
  await timeline.tools.getByRole('button', { name: 'Tall rows' }).click();
  const first = await timeline.middleOf(timeline.key('Gripper, 0.50 s, 1000 µs, linear'));
  const last = await timeline.middleOf(timeline.key('Gripper, 1.50 s, 1400 µs, linear'));
  const { y, height } = await timeline.grid.boundingBox();
  await page.mouse.move(first.x - 20, last.y - 12);
  await page.mouse.down();
  await page.mouse.move(last.x + 20, y + height + 20, { steps: 4 });
  await expect(timeline.region).toContainText('6 keys');
  await page.mouse.up();
  await page.keyboard.press('Delete');
  await expect(dashboard.button('Undo: delete 6 keys')).toBeVisible();
});

test('a locked row keeps its keys', async ({ page, dashboard }) => {
  const timeline = timelineOf(page);
  await dashboard.button('Row of Gripper').click();
  await page.getByRole('menuitem', { name: 'Lock', exact: true }).click();
  await timeline.drag('Gripper, 1.00 s, 1200 µs, linear', 40, 0);
  await expect(timeline.region).toContainText('This row is locked.');
  await page.mouse.up();
  await expect(timeline.key('Gripper, 1.00 s, 1200 µs, linear')).toBeVisible();
});

test('the wheel zooms where the pointer is, and all of it fits again', async ({ page, dashboard }) => {
  const timeline = timelineOf(page);
  const name = 'Gripper, 1.50 s, 1400 µs, linear';
  const before = await timeline.middleOf(timeline.key(name));
  await page.mouse.move(before.x, before.y);
  await page.mouse.wheel(0, -600);
  await expect(timeline.key('Gripper, 0.50 s, 1000 µs, linear')).toBeHidden();
  expect((await timeline.middleOf(timeline.key(name))).x).toBeCloseTo(before.x, -1);

  // Dragged past the end of the tracks it takes them along.
  const tracks = await timeline.grid.boundingBox();
  await page.mouse.down();
  await page.mouse.move(tracks.x + tracks.width - 2, before.y, { steps: 4 });
  const seen = await timeline.minimap.getAttribute('aria-valuetext');
  await page.mouse.move(tracks.x + tracks.width + 6, before.y);
  await expect(timeline.minimap).not.toHaveAttribute('aria-valuetext', seen ?? '');
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await dashboard.resume.click();
  await dashboard.button('Fit all').click();
  await expect(timeline.key('Gripper, 0.50 s, 1000 µs, linear')).toBeVisible();
});

test('the key under the cursor is named for ears while it is there, and its row where it is out of sight', async ({
  page,
  dashboard,
}) => {
  const timeline = timelineOf(page);
  const first = timeline.key('Gripper, 0.50 s, 1000 µs, linear');
  const named = (): Promise<string | null> =>
    timeline.grid.evaluate((grid) => {
      const id = grid.getAttribute('aria-activedescendant');
      return id === null ? null : (document.getElementById(id)?.role ?? 'nothing that is there');
    });
  await timeline.click('Gripper, 0.50 s, 1000 µs, linear');
  expect(await named()).toBe('gridcell');
  await page.mouse.move(0, 0);
  const last = await timeline.middleOf(timeline.key('Gripper, 1.50 s, 1400 µs, linear'));
  await page.mouse.move(last.x, last.y);
  await page.mouse.wheel(0, -600);
  await expect(first).toBeHidden();
  expect(await named()).toBe('row');
  await dashboard.button('Fit all').click();
  await expect(first).toBeVisible();
  expect(await named()).toBe('gridcell');
});

test('positions are read and typed in degrees where the page is', async ({ page, dashboard }) => {
  await page.getByRole('group', { name: 'Positions in' }).getByRole('radio', { name: '°' }).check();
  const timeline = timelineOf(page);
  await timeline.click('Gripper, 1.00 s, -27.0°, linear');
  await expect(timeline.region).toContainText('nudge with arrows by 20 ms or 1.0°');
  await page.keyboard.type('9');
  await page.keyboard.type('.9');
  await page.keyboard.press('Enter');
  await expect(timeline.key('Gripper, 1.00 s, 9.9°, linear')).toBeVisible();
  await page.keyboard.press('ArrowUp');
  await expect(timeline.key('Gripper, 1.00 s, 10.9°, linear')).toBeVisible();
  await dashboard.button('Undo: move keys').click();
  await dashboard.button('Undo: position of keys').click();
  await expect(timeline.key('Gripper, 1.00 s, -27.0°, linear')).toBeVisible();
});

test('a stretch is pulled at its beginning, the middle button pans, and the line below says what a press would do', async ({
  page,
  dashboard,
}) => {
  await expect(dashboard.frames).toHaveCount(3);
  const timeline = timelineOf(page);
  const first = await timeline.middleOf(timeline.key('All servos, frame 2, 1.00 s, 2 keys'));
  const last = await timeline.middleOf(timeline.key('All servos, frame 3, 1.50 s, 2 keys'));
  await timeline.click('All servos, frame 2, 1.00 s, 2 keys');
  await timeline.click('All servos, frame 3, 1.50 s, 2 keys', ['Shift']);
  await page.mouse.move(first.x - 12, first.y);
  await expect(timeline.region).toContainText('The last key stays.');
  await page.mouse.down();
  await page.mouse.move(first.x - 12 - (last.x - first.x) / 2, first.y, { steps: 6 });
  await page.mouse.up();
  await expect(
    timeline.grid.getByRole('gridcell', { name: /^All servos, frame 2, 0\.7\d s, 2 keys$/ }),
  ).toBeVisible();
  await expect(timeline.key('All servos, frame 3, 1.50 s, 2 keys')).toBeVisible();
  await page.mouse.move(last.x, last.y + 60);
  await page.mouse.down({ button: 'middle' });
  await page.mouse.move(last.x - 150, last.y + 60, { steps: 4 });
  await page.mouse.up({ button: 'middle' });
  const moved = await timeline.middleOf(timeline.key('All servos, frame 3, 1.50 s, 2 keys'));
  expect(moved.x).toBeCloseTo(last.x - 150, -1);
});

test('a box takes the keys of one row, and a stretch of them leaves the other row alone', async ({
  page,
  dashboard,
}) => {
  await expect(dashboard.frames).toHaveCount(3);
  const timeline = timelineOf(page);
  const first = await timeline.middleOf(timeline.key('Gripper, 0.50 s, 1000 µs, linear'));
  const second = await timeline.middleOf(timeline.key('Gripper, 1.00 s, 1200 µs, linear'));
  const last = await timeline.middleOf(timeline.key('Gripper, 1.50 s, 1400 µs, linear'));
  const frames = await timeline.middleOf(timeline.key('All servos, frame 3, 1.50 s, 2 keys'));
  await page.mouse.move(first.x - 14, Math.max(first.y, last.y) + 9);
  await page.mouse.down();
  await page.mouse.move(last.x + 14, Math.min(first.y, last.y) - 9, { steps: 6 });
  await page.mouse.up();
  await expect(timeline.region).toContainText('3 keys');
  await page.mouse.move(last.x + 12, frames.y);
  await expect(timeline.region).toContainText('With Ripple, later frames move along.');
  await page.mouse.down();
  await page.mouse.move(last.x + 12 - (last.x - second.x) / 2, frames.y, { steps: 6 });
  await page.mouse.up();
  const stretched = timeline.grid.getByRole('gridcell', {
    name: /^Gripper, 1\.2\d s, 1400 µs, linear$/,
  });
  await expect(stretched).toHaveAttribute('aria-selected', 'true');
  await expect(timeline.key('Gripper, 0.50 s, 1000 µs, linear')).toBeVisible();
  for (const at of ['0.50', '1.00', '1.50'])
    await expect(timeline.key(`Elbow, ${at} s, 1500 µs, linear`)).toBeVisible();
});

test('the middle button pans and pastes nothing', async ({ page, dashboard }) => {
  await expect(dashboard.frames).toHaveCount(3);
  const timeline = timelineOf(page);
  await timeline.click('Gripper, 1.00 s, 1200 µs, linear');
  await page.keyboard.press('Control+c');
  const { x, y } = await timeline.middleOf(timeline.key('Gripper, 1.50 s, 1400 µs, linear'));
  await page.mouse.move(x, y + 60);
  await page.mouse.down({ button: 'middle' });
  await page.mouse.move(x - 150, y + 60, { steps: 4 });
  await page.mouse.up({ button: 'middle' });
  await dashboard.frame(1).click({ button: 'middle' });
  await expect(timeline.key('Gripper, 1.50 s, 1400 µs, linear')).toBeVisible();
  await expect(dashboard.frames).toHaveCount(3);
  await expect(dashboard.button('Undo')).toBeDisabled();
});

test('a muted row is not sent when the page plays', async ({ page, dashboard, robot }) => {
  await expect(dashboard.frames).toHaveCount(3);
  await dashboard.button('Row of Elbow').click();
  await page.getByRole('menuitem', { name: 'Mute', exact: true }).click();
  const tools = page.getByRole('group', { name: 'Play the group' });
  await expect(tools.getByRole('status')).toHaveText('Not sent from here: Elbow. The board plays every row.');
  await dashboard.button('Play').click();
  await expect(dashboard.status).toContainText('Playing');
  await expect(dashboard.status).toHaveText('Idle');
  const moves = ofKind(await robot.bus(), 'move');
  expect(new Set(moves.flatMap(({ targets }) => targets.map(({ servo }) => servo)))).toEqual(new Set([1]));
});

test('a marked part that ends far from where it begins goes back gently and says so', async ({
  page,
  dashboard,
  robot,
}) => {
  await expect(dashboard.frames).toHaveCount(3);
  const timeline = timelineOf(page);
  await timeline.click('Gripper, 1.00 s, 1200 µs, linear');
  await timeline.click('Gripper, 1.50 s, 1400 µs, linear', ['Shift']);
  await page.keyboard.press('l');
  await page.getByRole('switch', { name: 'Loop' }).check();
  await dashboard.button('Play').click();
  await expect(page.getByRole('group', { name: 'Play the group' }).getByRole('status')).toHaveText(
    'The loop ends far from its start: moving back slowly',
  );
  const moves = ofKind(await robot.bus(), 'move').filter(({ durationMs }) => durationMs === 1500);
  expect(moves.length, 'to the first pose, and back to it').toBeGreaterThanOrEqual(2);
  await dashboard.stop.click();
});

test('Space plays the group while the timeline has the focus', async ({ page, dashboard }) => {
  await timelineOf(page).grid.focus();
  await page.keyboard.press('Space');
  await expect(dashboard.status).toContainText('Playing frame 1 of 3');
});

test.describe('with fingers', () => {
  test.override({ screen: { hasTouch: true }, viewport: { width: 390, height: 844 } });

  test('a finger that rests opens the menu, two fingers zoom', async ({ dashboard: { page } }) => {
    await page.getByRole('tab', { name: 'Animate' }).click();
    const timeline = timelineOf(page);
    await expect(timeline.region).toContainText('Rest a finger for more');
    const name = 'Gripper, 1.00 s, 1200 µs, linear';
    await timeline.key(name).scrollIntoViewIfNeeded();
    const at = await timeline.middleOf(timeline.key(name));
    const { touch } = page.touchscreen;
    await touch('touchStart', at, { x: at.x + 40, y: at.y });
    await touch('touchMove', { x: at.x - 40, y: at.y }, { x: at.x + 120, y: at.y });
    await touch('touchEnd');
    await expect(timeline.key('Gripper, 1.50 s, 1400 µs, linear')).toBeHidden();
    await page.getByRole('button', { name: 'Fit all' }).tap();
    await expect(timeline.key('Gripper, 1.50 s, 1400 µs, linear')).toBeVisible();
    await touch('touchStart', await timeline.middleOf(timeline.key(name)));
    await expect(timeline.region).toContainText('Lift for the menu');
    await touch('touchEnd');
    await page.getByRole('menuitem', { name: 'Delete keys' }).tap();
    await expect(timeline.key(name)).toBeHidden();
    await timeline.tools.getByRole('button', { name: 'Several' }).tap();
    for (const beside of ['Gripper, 0.50 s, 1000 µs, linear', 'Elbow, 1.50 s, 1500 µs, linear']) {
      await touch('touchStart', await timeline.middleOf(timeline.key(beside)));
      await touch('touchEnd');
    }
    await expect(timeline.selected).toHaveCount(2);
  });

  test('arrows below the tracks nudge what is selected in time and value', async ({
    dashboard: { page },
  }) => {
    await page.getByRole('tab', { name: 'Animate' }).click();
    const timeline = timelineOf(page);
    const arrow = (name: string) =>
      timeline.region.getByRole('group', { name: 'Nudge' }).getByRole('button', { name });
    await expect(arrow('Later by 20 ms')).toBeDisabled();
    const key = timeline.key('Gripper, 1.00 s, 1200 µs, linear');
    await key.scrollIntoViewIfNeeded();
    const { touch } = page.touchscreen;
    await touch('touchStart', await timeline.middleOf(key));
    await touch('touchEnd');
    await arrow('Later by 20 ms').tap();
    await arrow('Higher by 1 µs').tap();
    await arrow('Higher by 1 µs').tap();
    await expect(timeline.key('Gripper, 1.02 s, 1202 µs, linear')).toBeAttached();
    await arrow('Earlier by 20 ms').tap();
    await arrow('Lower by 1 µs').tap();
    await expect(timeline.key('Gripper, 1.00 s, 1201 µs, linear')).toBeAttached();
  });
});
