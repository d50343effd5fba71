// The main job by keyboard alone: every control is reached by Tab in reading order, the focus is always to be seen.

import type { Locator } from './harness/locator.ts';
import type { Page } from './harness/page.ts';
import * as rings from '../../e2e/fixtures/rings.ts';
import * as robotDialog from '../../e2e/fixtures/robotDialog.ts';
import { looks } from './harness/sound.ts';
import { dashboardOf, expect, here, poll, test } from './harness/test.ts';

const { cutRing } = here(rings);
const { robotDialogOf } = here(robotDialog);
const { timelineOf } = here(timeline);
import * as timeline from '../../e2e/fixtures/timeline.ts';

/** More than there are stops on the page. */
const MOST_TABS = 80;

/** Presses Tab until `wanted` has the focus. */
async function tabTo(page: Page, wanted: Locator, key: 'Tab' | 'Shift+Tab' = 'Tab'): Promise<void> {
  for (let presses = 0; presses < MOST_TABS; presses += 1) {
    if (await holdsFocus(wanted)) return;
    await page.keyboard.press(key);
  }
  throw new Error(`Tab does not lead to ${wanted.selector}`);
}

function holdsFocus(place: Locator): Promise<boolean> {
  return place.evaluate((element) => element.contains(document.activeElement));
}

test('the main job needs no mouse', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  const { keyboard } = page;
  await page.goto(url);
  await expect(dashboard.link).toHaveText(/Ready/);
  await expect(dashboard.estimate(6)).toHaveText('≈ 1500');

  await tabTo(page, dashboard.slider(6));
  await keyboard.press('PageUp');
  await expect(dashboard.estimate(6)).toHaveText('≈ 1600');
  await tabTo(page, dashboard.capture);
  await keyboard.press('Enter');
  await keyboard.press('Enter');
  await expect(dashboard.frames).toHaveCount(2);
  await tabTo(page, dashboard.slot);
  await keyboard.press('ControlOrMeta+a');
  await keyboard.type('5');
  await tabTo(page, dashboard.button('Download'));
  await keyboard.press('Enter');
  await expect(dashboard.notices).toContainText('Slot 5 is downloaded.');
  await tabTo(page, dashboard.untilStopped);
  await keyboard.press('Space');
  await tabTo(page, dashboard.button('Run'), 'Shift+Tab');
  await keyboard.press('Enter');
  await expect(dashboard.status).toContainText('Running slot 5, until stopped');
  await tabTo(page, dashboard.stop);
  await keyboard.press('Enter');
  await expect(dashboard.status).toContainText('Stop sent');
  await tabTo(page, dashboard.resume);
  await keyboard.press('Enter');
  await expect(dashboard.status).toHaveText('Idle');
});

test('F6 goes from part to part, each time to where the keys were in it', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  const { keyboard } = page;
  const next = async (key: 'F6' | 'Shift+F6', wanted: Locator) => {
    await keyboard.press(key);
    expect(await holdsFocus(wanted)).toBe(true);
  };
  const part = (name: string) => page.getByRole('region', { name, exact: true });
  await page.goto(url);
  await expect(dashboard.estimate(6)).toHaveText('≈ 1500');

  await next('F6', page.getByRole('banner'));
  await next('F6', part('Servos'));
  await dashboard.slider(6).focus();
  const choice = page.getByRole('radio', { name: 'Action group' });
  await next('F6', choice);
  await next('F6', part('Action group'));
  expect(await holdsFocus(choice)).toBe(false);
  await dashboard.capture.focus();
  await next('F6', part('Timeline'));
  for (const name of ['Board', 'Battery', 'Log']) await next('F6', part(name));
  await next('F6', page.getByRole('banner'));
  await next('Shift+F6', part('Log'));
  for (const name of ['Battery', 'Board', 'Timeline']) await next('Shift+F6', part(name));
  await next('Shift+F6', dashboard.capture);
  await next('Shift+F6', choice);
  await next('Shift+F6', dashboard.slider(6));
});

test('arrows go through the three that are worked on, and back', async ({ page, url }) => {
  const part = (name: string): Locator => page.getByRole('radio', { name });
  await page.goto(url);
  await part('Action group').focus();
  for (const [key, name] of [
    ['ArrowRight', 'Poses'],
    ['ArrowRight', 'Keys and pad'],
    ['ArrowLeft', 'Poses'],
  ] as const) {
    await page.keyboard.press(key);
    await expect(part(name)).toBeChecked();
    await expect(part(name)).toBeFocused();
  }
});

test('on a phone arrows go from tab to tab, around both ends', async ({ page, url }) => {
  const tab = (name: string): Locator => page.getByRole('tab', { name });
  await page.setViewportSize({ width: 390, height: 844 });
  await page.goto(url);
  await tabTo(page, tab('Drive'), 'Shift+Tab');
  for (const [key, name] of [
    ['ArrowRight', 'Animate'],
    ['ArrowLeft', 'Drive'],
    ['ArrowLeft', 'Buttons'],
    ['ArrowRight', 'Drive'],
    ['End', 'Buttons'],
    ['Home', 'Drive'],
  ] as const) {
    await page.keyboard.press(key);
    await expect(tab(name)).toBeFocused();
    await expect(tab(name)).toHaveAttribute('aria-selected', 'true');
    await expect(page.getByRole('tabpanel', { name })).toBeVisible();
  }
});

test('a dialog shares the focus with STOP alone, and gives it back', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await expect(dashboard.link).toHaveText(/Ready/);
  await tabTo(page, dashboard.button('Connect'));
  await page.keyboard.press('Enter');
  await expect(dashboard.connectDialog).toBeVisible();
  await poll(() => holdsFocus(dashboard.connectDialog)).toBe(true);
  const stops = [dashboard.connectDialog, dashboard.stop];
  for (let presses = 0; presses < 12; presses += 1) {
    await page.keyboard.press('Tab');
    await poll(() => Promise.all(stops.map(holdsFocus))).toContain(true);
  }
  await dashboard.connectDialog.getByRole('button', { name: 'Close' }).press('Enter');
  await expect(dashboard.button('Connect')).toBeFocused();
});

test('what has the focus goes away, and the focus is where one goes on', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  const robots = robotDialogOf(dashboard);
  const { keyboard } = page;
  const asked = (what: RegExp): Locator => robots.dialog.getByText(what);
  const press = async (button: Locator): Promise<void> => {
    await tabTo(page, button);
    await keyboard.press('Enter');
  };
  await page.goto(url);
  await expect(dashboard.link).toHaveText(/Ready/);
  await expect(dashboard.estimate(6)).toHaveText('≈ 1500');

  await press(robots.opener);
  await press(robots.button('Calibrate'));
  await expect(asked(/until it is closed/)).toBeFocused();
  await press(robots.button(/^Keep 500/));
  await expect(asked(/^Now wide open/)).toBeFocused();
  await press(robots.button(/^Keep 2500/));
  await expect(asked(/half open/)).toBeFocused();
  await press(robots.button(/^Keep 1500/));
  await expect(asked(/: watch the gripper/)).toBeFocused();
  await expect(robots.button('Turn a little')).toBeEnabled();
  await press(robots.button('Turn a little'));
  await expect(robots.button('Yes, that way')).toBeEnabled({ timeout: 15_000 });
  await expect(robots.button('Turn a little')).toBeFocused();
  await press(robots.button('Yes, that way'));
  await expect(asked(/one end of its range/)).toBeFocused();
  await press(robots.button('Close'));
  await expect(robots.opener).toBeFocused();

  await page.getByRole('radio', { name: 'Poses' }).check();
  await press(dashboard.button('Capture pose'));
  await expect(page.getByRole('textbox', { name: /^Name of Pose/ })).toBeFocused();
  await keyboard.type('Wave');
  await keyboard.press('Enter');
  await expect(dashboard.button('Capture pose')).toBeFocused();
  await page.getByRole('textbox', { name: 'Name of Wave' }).focus();
  await keyboard.type('Bow');
  await keyboard.press('Enter');
  const renamed = page.getByRole('textbox', { name: /Bow/ });
  await expect(renamed).toBeFocused();
  const undo = page.getByRole('button', { name: /^Undo/ });
  await undo.focus();
  await keyboard.press('Enter');
  await expect(renamed).toBeHidden();
  await keyboard.press('Enter');
  await expect(page.getByRole('textbox', { name: /^Name of Pose/ })).toBeVisible();
  await keyboard.press('Enter');
  await expect(undo).toBeDisabled();
  await poll(() => page.evaluate(() => document.activeElement?.contains(document.body))).toBe(false);
});

/** Opens by key, leaves by key; what opened it has the focus again. */
async function throughDialog(page: Page, opener: Locator, name: string, within: () => Promise<void>) {
  const dialog = page.getByRole('dialog', { name });
  await tabTo(page, opener);
  await page.keyboard.press('Enter');
  await expect(dialog).toBeVisible();
  await poll(() => holdsFocus(dialog)).toBe(true);
  await within();
  await tabTo(page, dialog.getByRole('button', { name: 'Close', exact: true }));
  await page.keyboard.press('Enter');
  await expect(dialog).toBeHidden();
  await expect(opener).toBeFocused();
}

test('robots, library, files, keys over time, slots and poses need no mouse', async ({ page, url }) => {
  // Each press of Tab is one of a person, and there are many of them.
  const dashboard = dashboardOf(page);
  const { keyboard } = page;
  const radio = (name: string): Locator => page.getByRole('radio', { name, exact: true });
  await page.goto(url);
  await expect(dashboard.link).toHaveText(/Ready/);
  await expect(dashboard.estimate(6)).toHaveText('≈ 1500');

  const robots = robotDialogOf(dashboard);
  await throughDialog(page, robots.opener, 'Robots', async () => {
    await tabTo(page, robots.button('Calibrate'));
    await keyboard.press('Enter');
    await tabTo(page, robots.jog('higher'));
    await keyboard.down(' ');
    await expect(robots.now).toContainText(/15[1-9]\d|1[6-9]\d\d/);
    await keyboard.up(' ');
  });
  await throughDialog(page, dashboard.button('Library'), 'Library', async () => {
    await keyboard.press('Tab');
  });
  await throughDialog(page, dashboard.button('Files'), 'Files', async () => {
    await expect(page.getByRole('dialog')).toContainText('There are no frames to save yet.');
  });
  await tabTo(page, dashboard.capture);
  await keyboard.press('Enter');
  await keyboard.press('Enter');
  await expect(dashboard.frames).toHaveCount(2);
  await throughDialog(page, dashboard.button('Slots'), 'Slots of the board', async () => {
    const map = page.getByRole('listbox', { name: 'Map of the slots' });
    await tabTo(page, map);
    await keyboard.press('ArrowRight');
    await expect(map.getByRole('option', { selected: true })).toHaveAccessibleName(/^Slot 22:/);
  });
  const timeline = timelineOf(page);
  await tabTo(page, timeline.grid, 'Shift+Tab');
  await keyboard.press('Control+ArrowDown');
  await keyboard.type('1720');
  await keyboard.press('Enter');
  await expect(timeline.selected).toHaveAccessibleName(/1720 µs/);
  await expect(timeline.grid).toBeFocused();
  await tabTo(page, radio('Action group'), 'Shift+Tab');
  await keyboard.press('ArrowRight');
  await expect(radio('Poses')).toBeChecked();
  await tabTo(page, dashboard.button('Capture pose'));
  await keyboard.press('Enter');
  await expect(page.getByRole('button', { name: /^Go to Pose/ })).toHaveCount(1);
});

test('a button presses once for a key that is held', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await expect(dashboard.estimate(6)).toHaveText('≈ 1500');
  await dashboard.capture.click();
  await expect(dashboard.frames).toHaveCount(1);
  await dashboard.button('Duplicate').focus();
  for (let repeat = 0; repeat < 5; repeat += 1) await page.keyboard.down('Enter');
  await page.keyboard.up('Enter');
  await expect(dashboard.frames).toHaveCount(2);
});

for (const viewport of looks([
  { width: 1440, height: 900 },
  { width: 1280, height: 720 },
  { width: 820, height: 1180 },
])) {
  test.describe(`a window ${viewport.width} pixels wide`, () => {
    test.override({ viewport });

    test('shows all of the ring around what has the focus, after Escape too', async ({ page, url }) => {
      const dashboard = dashboardOf(page);
      await page.goto(url);
      await expect(dashboard.estimate(6)).toHaveText('≈ 1500');
      await dashboard.capture.click();
      await expect(dashboard.frames).toHaveCount(1);
      const library = page.getByRole('button', { name: 'Library', exact: true });
      for (const element of [timelineOf(page).grid, library, dashboard.button('Connect')]) {
        await element.focus();
        await page.keyboard.press('Escape');
        expect.soft(await cutRing(page)).toBeNull();
      }
      const cut = new Set<string>();
      for (let presses = 0; presses < MOST_TABS; presses += 1) {
        await page.keyboard.press('Tab');
        const how = await cutRing(page);
        if (how !== null) cut.add(how);
      }
      expect([...cut]).toEqual([]);
    });
  });
}
