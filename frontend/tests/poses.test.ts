// Poses: kept, changed and gone to. What the board heard says whether something moved.

import * as robotDialog from '../../e2e/fixtures/robotDialog.ts';
import type { Page } from './harness/page.ts';
import { lastTarget, ofKind } from '../../e2e/fixtures/bus.ts';
import { expect, here, poll, test, type Dashboard } from './harness/test.ts';

const { robotDialogOf } = here(robotDialog);

function posesOf(page: Page) {
  const list = page.getByRole('list', { name: 'Poses' });
  return {
    cards: list.getByRole('listitem'),
    card: (name: string) => list.getByRole('button', { name: new RegExp(`^${name}\\b`) }),
    names: () =>
      list.getByRole('textbox').evaluateAll((fields) => fields.map((one) => (one as HTMLInputElement).value)),
    async capture(dashboard: Dashboard, position: number, name: string) {
      await dashboard.type(dashboard.target(1), position);
      await expect(dashboard.estimate(1)).toHaveText(`≈ ${position}`);
      const before = await list.getByRole('listitem').count();
      await dashboard.button('Capture pose').click();
      await expect(list.getByRole('listitem')).toHaveCount(before + 1);
      const field = list.getByRole('textbox').last();
      await field.fill(name);
      await field.press('Enter');
      await expect(this.card(name)).toHaveAttribute('aria-pressed', 'true');
    },
  };
}

test.beforeEach(async ({ dashboard, page }) => {
  await page.getByRole('radio', { name: 'Poses' }).check();
  await expect(dashboard.button('Capture pose')).toBeDisabled();
});

test('a captured pose is gone to slowly; undoing that moves nothing', async ({ dashboard, page, robot }) => {
  const poses = posesOf(page);
  await poses.capture(dashboard, 1800, 'Wave');
  await poses.capture(dashboard, 1200, 'Bow');
  await dashboard.button('Go to Wave, in 1500 ms').click();
  await poll(() => lastTarget(robot.bus, 1)).toBe(1800);
  // In two parts.
  const sent = ofKind(await robot.bus(), 'move').slice(-2);
  expect(sent.map(({ durationMs }) => durationMs)).toEqual([1000, 560]);
  await expect(poses.card('Wave')).toHaveAccessibleName(/Last used$/);

  const moves = ofKind(await robot.bus(), 'move').length;
  await dashboard.button('Undo: go to Wave').click();
  await expect(poses.card('Wave')).not.toHaveAccessibleName(/Last used$/);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1800');
  expect(ofKind(await robot.bus(), 'move')).toHaveLength(moves);
});

test('home takes every servo to its home in the chosen time, rest goes where it was marked', async ({
  dashboard,
  page,
  robot,
}) => {
  const poses = posesOf(page);
  await poses.capture(dashboard, 900, 'Crouch');
  await page.getByRole('switch', { name: 'Use as rest pose' }).check();
  await dashboard.type(dashboard.field('Time to reach a pose in milliseconds'), 2000);
  await dashboard.button('Home').click();
  await poll(() => lastTarget(robot.bus, 6)).toBe(1500);
  await dashboard.button('Rest').click();
  await poll(() => lastTarget(robot.bus, 1)).toBe(900);
  // In parts, beside the first moves of others that are still under way.
  const last = ofKind(await robot.bus(), 'move').at(-1);
  expect(last?.targets).toContainEqual({ servo: 1, position: 900 });
});

test('poses are flipped, blended, reordered and deleted; each is undone', async ({
  dashboard,
  page,
  robot,
}) => {
  const poses = posesOf(page);
  await poses.capture(dashboard, 1800, 'Wave');
  await poses.capture(dashboard, 1200, 'Bow');
  await dashboard.button('Flip').click();
  await page.getByRole('switch', { name: 'Blend', exact: true }).check();
  await page.getByRole('combobox', { name: 'Blend with' }).selectOption('Wave');
  const share = page.getByRole('slider', { name: 'Share of Wave' });
  await expect(share).toHaveAttribute('aria-valuetext', '50%');
  await share.fill('100');
  await share.press('ArrowLeft');
  await expect(share).toHaveAttribute('aria-valuetext', '99%');
  await dashboard.button('Go to blend').click();
  // Bow flipped about 1500 is 1800, as Wave is.
  await poll(() => lastTarget(robot.bus, 1)).toBe(1800);

  await poses.card('Bow').press('Alt+ArrowLeft');
  await poll(() => poses.names()).toEqual(['Bow', 'Wave']);
  await poses.card('Bow').press('Delete');
  await poll(() => poses.names()).toEqual(['Wave']);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await poll(() => poses.names()).toEqual(['Wave', 'Bow']);
});

test('a pose is about the servos that were chosen', async ({ dashboard, page, robot }) => {
  const poses = posesOf(page);
  await dashboard.type(dashboard.target(2), 1700);
  await poses.capture(dashboard, 1800, 'Grip');
  await page.getByRole('switch', { name: 'Servos', exact: true }).check();
  await page.getByRole('checkbox', { name: 'Wrist roll' }).uncheck();
  await expect(poses.card('Grip')).toHaveAccessibleName(/^Grip, 1 of 6 servos/);
  await dashboard.button(/^Go to Grip/).click();
  await poll(async () => ofKind(await robot.bus(), 'move').at(-1)?.targets).toEqual([
    { servo: 1, position: 1800 },
  ]);
});

test('servos that are called alike are chosen by their limb', async ({ dashboard, page }) => {
  const robots = robotDialogOf(dashboard);
  await robots.opener.click();
  await robots.button(/^Add Humanoid, 16 servos/).click();
  await robots.button('Close').click();
  await posesOf(page).capture(dashboard, 1800, 'Stand');
  await page.getByRole('switch', { name: 'Servos', exact: true }).check();
  const limb = (name: string) => page.getByRole('group', { name, exact: true });
  await expect(limb('Left leg').getByRole('checkbox', { name: 'Knee' })).toHaveCount(1);
  await expect(limb('Left leg').getByRole('checkbox', { name: 'Foot' })).toBeChecked();
  await expect(limb('Right leg').getByRole('checkbox', { name: 'Foot' })).not.toBeChecked();
});

test('a servo of a file that the robot does not have can be left out', async ({ dashboard, page }) => {
  const targets = [2, 31].map((servo) => ({ servo, position: 1500 }));
  const content = {
    poses: [{ id: 1, name: 'Odd', unit: 'us', targets }],
    restId: null,
    applied: null,
    nextId: 2,
  };
  const choosing = page.waitForEvent('filechooser');
  await dashboard.button('Import poses').click();
  await (
    await choosing
  ).setFiles({
    name: 'odd.json',
    mimeType: 'application/json',
    buffer: new TextEncoder().encode(JSON.stringify({ format: 'servodeck-poses', version: 1, content })),
  });
  await expect(dashboard.notices).toContainText('These poses also move servos that this robot does not have');
  await expect(posesOf(page).card('Odd')).toHaveAccessibleName(/^Odd, 2 of 7 servos/);
  await posesOf(page).card('Odd').click();
  await page.getByRole('switch', { name: 'Servos', exact: true }).check();
  const stranger = page.getByRole('checkbox', { name: 'Servo 31, not on this robot' });
  await stranger.click();
  await expect(stranger).toBeHidden();
  await expect(posesOf(page).card('Odd')).toHaveAccessibleName(/^Odd, 1 of 6 servos/);
});

test('poses become frames of the action group, one behind the other', async ({ dashboard, page, robot }) => {
  const poses = posesOf(page);
  await poses.capture(dashboard, 1800, 'Wave');
  await poses.capture(dashboard, 1200, 'Bow');
  const moves = ofKind(await robot.bus(), 'move').length;
  await dashboard.button('Add to group').click();
  await poses.card('Wave').click();
  await dashboard.button('Add to group').click();
  await expect(dashboard.notices).toContainText('Wave was added to the action group as a frame.');
  await dashboard.notices.getByRole('button', { name: 'Show it' }).last().click();
  await expect(dashboard.frames).toHaveCount(2);
  await expect(dashboard.frame(2)).toHaveAccessibleName(/^Frame 2, 1000 ms, moves servo 1/);
  expect(ofKind(await robot.bus(), 'move')).toHaveLength(moves);
});

test('poses outlive a reload, and leave and come as a file', async ({ dashboard, page }) => {
  const poses = posesOf(page);
  await poses.capture(dashboard, 1800, 'Wave');
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    dashboard.button('Export poses').click(),
  ]);
  const text = await download.text();
  await page.reload();
  await expect(page.getByRole('radio', { name: 'Poses' })).toBeChecked();
  await expect(poses.cards).toHaveCount(1);
  const take = async (content: string): Promise<void> => {
    const [chooser] = await Promise.all([
      page.waitForEvent('filechooser'),
      dashboard.button('Import poses').click(),
    ]);
    const buffer = new TextEncoder().encode(content);
    await chooser.setFiles({ name: 'poses.json', mimeType: 'application/json', buffer });
  };
  await take(text.replace('1800', '9000'));
  await expect(dashboard.notices).toContainText('9000 is out of range');
  await take(text);
  await poll(() => poses.names()).toEqual(['Wave', 'Wave']);
});
