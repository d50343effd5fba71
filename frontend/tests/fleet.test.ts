// The fleet page: what a person reads first, the selection, and STOP of all, of some and by Esc.

import type { Page } from './harness/page.ts';
import { expect, test } from './harness/test.ts';

const at = (page: Page, url: string, state: string): Promise<unknown> =>
  page.goto(`${url}/gallery.html?language=en&state=${encodeURIComponent(state)}`);

test('who needs a person comes first, and the head says how many', async ({ page, url }) => {
  await at(page, url, 'Fleet');
  await expect(page.getByText('5 robots need a person')).toBeVisible();
  const cards = page.getByRole('list', { name: 'Robots' }).getByRole('listitem');
  await expect(cards).toHaveCount(8);
  await expect(cards.nth(0)).toContainText('Arm 7');
  await expect(cards.nth(0)).toContainText('Name used twice');
  await expect(cards.nth(1)).toContainText('Robot not connected');
  await expect(cards.nth(2)).toContainText('Last seen 2 min. ago');
  await expect(cards.nth(2)).toContainText('Last known: 7.50 V');
  await expect(cards.nth(2)).not.toContainText('No driver');
  await expect(cards.nth(3)).toContainText('Stopped by Ben');
  await expect(cards.nth(4)).toContainText('Battery low');
  await expect(cards.nth(4)).toContainText('Running Bow');
  await expect(page.getByText('Arm 5: The robot is not connected.')).toBeVisible();
  await expect(page.getByRole('button', { name: 'Try 1 again' })).toBeEnabled();
});

test('the selected robots get what they have in common; who takes no part is named', async ({
  page,
  url,
}) => {
  await at(page, url, 'Fleet');
  const actions = page.getByRole('group', { name: '3 robots selected' });
  await expect(actions.getByRole('combobox', { name: 'Action group to run' })).toHaveValue('Bow');
  await expect(actions.getByRole('button', { name: 'Run on 2' })).toBeEnabled();
  await expect(actions).toContainText('Take no part: Arm 4 (Stopped).');
  await page.getByRole('checkbox', { name: 'Select Hexapod' }).check();
  await expect(page.getByText('These robots have no action group in common.')).toBeVisible();
  await page.getByRole('searchbox', { name: 'Search robots' }).fill('hexa');
  await expect(page.getByRole('list', { name: 'Robots' }).getByRole('listitem')).toHaveCount(1);
});

test('a number that a run does not take is refused with the numbers that it takes', async ({ page, url }) => {
  await at(page, url, 'Fleet');
  const actions = page.getByRole('group', { name: '3 robots selected' });
  const times = actions.getByRole('textbox', { name: 'Times' });
  await times.fill('0');
  await times.press('Enter');
  await expect(actions).toContainText('Times: 0 is out of range; it takes 1 to 255.');
  await expect(times).toHaveValue('1');
  await times.fill('2');
  await times.press('Enter');
  await expect(actions).not.toContainText('out of range');
});

test('those that all take no part for one reason are not listed one by one', async ({ page, url }) => {
  await at(page, url, 'Fleet');
  const stopped = page.getByRole('checkbox', { name: 'Select Arm 4' });
  await page.getByRole('button', { name: 'Select all 8' }).click();
  await page.getByRole('button', { name: 'Select none' }).click();
  await expect(page.getByText('Select robots to act on several at once.')).toBeVisible();
  await stopped.check();
  await expect(page.getByRole('group', { name: '1 robot selected' })).toContainText(
    'Take no part: Arm 4 (Stopped).',
  );
});

test('Esc stops all, also while a person types; the button of a selection stops it alone', async ({
  page,
  url,
}) => {
  await at(page, url, 'Fleet');
  await page.getByRole('button', { name: 'Stop these 3' }).click();
  await expect(page.getByText('3 robots stopped')).toBeVisible();
  await page.getByRole('searchbox', { name: 'Search robots' }).fill('arm');
  await page.keyboard.press('Escape');
  await expect(page.getByText('8 robots stopped')).toBeVisible();
});

test('a cue says who is ready, GO starts it and makes the next one current', async ({ page, url }) => {
  await at(page, url, 'Fleet');
  const cues = page.getByRole('region', { name: 'Cues' });
  const steps = cues.getByRole('listitem');
  await expect(steps.nth(0)).toContainText('Wave, Table 1, 2 times');
  await expect(steps.nth(0)).toContainText('2 of 2 ready.');
  await expect(steps.nth(1)).toContainText('Missing: Arm 4, Arm 5, Arm 6, Arm 7, and Hexapod.');
  await cues.getByRole('button', { name: 'GO' }).click();
  await expect(steps.nth(1)).toHaveAttribute('aria-current', 'step');
  await cues.getByRole('button', { name: 'Next' }).click();
  await expect(cues.getByRole('button', { name: 'GO' })).toBeDisabled();
  await cues.getByRole('button', { name: 'Back to start' }).click();
  await expect(steps.nth(0)).toHaveAttribute('aria-current', 'step');
  await steps.nth(1).getByRole('button', { name: 'Bow, All robots' }).click();
  await expect(steps.nth(1)).toHaveAttribute('aria-current', 'step');
});

test('cues added one right after the other are all kept, and the current one stays current', async ({
  page,
  url,
}) => {
  await at(page, url, 'Fleet');
  const cues = page.getByRole('region', { name: 'Cues' });
  const steps = cues.getByRole('listitem');
  await cues.getByRole('button', { name: 'Add cue' }).click();
  await cues.getByRole('button', { name: 'Add cue' }).click();
  await expect(steps).toHaveCount(4);
  await cues.getByRole('button', { name: 'GO' }).click();
  await expect(steps.nth(1)).toHaveAttribute('aria-current', 'step');
  await cues.getByRole('button', { name: 'Remove the cue Wave' }).click();
  await expect(steps).toHaveCount(3);
  await expect(steps.nth(0)).toContainText('Bow');
  await expect(steps.nth(0)).toHaveAttribute('aria-current', 'step');
});

test('what the gateway refuses is said where it was asked, and a cue stays current', async ({
  page,
  url,
}) => {
  const refusal = 'The gateway is being updated.';
  await at(page, url, 'Fleet, refused');
  const tasks = page.getByRole('region', { name: 'Tasks' });
  await tasks.getByRole('button', { name: 'Try 1 again' }).click();
  await expect(tasks).toContainText(refusal);
  const cues = page.getByRole('region', { name: 'Cues' });
  await cues.getByRole('button', { name: 'GO' }).click();
  await expect(cues).toContainText(refusal);
  await expect(cues.getByRole('listitem').nth(0)).toHaveAttribute('aria-current', 'step');
  await page.getByRole('button', { name: 'Download …' }).click();
  const dialog = page.getByRole('dialog');
  await dialog.getByRole('checkbox', { name: 'Nod' }).click();
  await expect(dialog).toContainText('Nod cannot be read from the library.');
});

test('putting robots into a group does not hide whom a stop has not reached', async ({ page, url }) => {
  await at(page, url, 'Fleet, one not reached');
  await page.getByRole('checkbox', { name: 'Select Arm 1' }).check();
  await page.getByRole('textbox', { name: 'Group name' }).fill('Table 9');
  await page.getByRole('button', { name: 'Put into group' }).click();
  await expect(page.getByRole('combobox', { name: 'Group of robots' })).toContainText('Table 9');
  await expect(page.getByText('Not reached: Arm 6.')).toBeVisible();
});

test('a group that its last robot leaves is not searched for any more', async ({ page, url }) => {
  await at(page, url, 'Fleet');
  const cards = page.getByRole('list', { name: 'Robots' }).getByRole('listitem');
  await page.getByRole('combobox', { name: 'Group of robots' }).selectOption('Table 1');
  await expect(cards).toHaveCount(2);
  await page.getByRole('button', { name: 'Take out of group' }).click();
  await expect(cards).toHaveCount(8);
});

test('selected robots that the search hides are named', async ({ page, url }) => {
  await at(page, url, 'Fleet');
  const actions = page.getByRole('group', { name: '3 robots selected' });
  await expect(actions).not.toContainText('not shown');
  await page.getByRole('searchbox', { name: 'Search robots' }).fill('arm 2');
  await expect(actions).toContainText('Selected too, but not shown: Arm 1 and Arm 4.');
});

test('by keyboard no control of a card is reached under the bar of the selection', async ({ page, url }) => {
  await page.setViewportSize({ width: 1024, height: 600 });
  await at(page, url, 'Fleet');
  await page.getByRole('button', { name: 'GO' }).focus();
  const isCovered = (): Promise<boolean> =>
    page.evaluate(() => {
      const focused = document.activeElement;
      const { x, y, width, height } = focused?.getBoundingClientRect() ?? new DOMRect();
      const top = document.elementFromPoint(x + width / 2, y + height / 2);
      return top !== focused && focused?.contains(top) !== true;
    });
  const seen: string[] = [];
  while (!seen.at(-1)?.startsWith('Select Arm 7')) {
    await page.keyboard.press('Shift+Tab');
    const name = await page.evaluate(() => document.activeElement?.getAttribute('aria-label') ?? '');
    seen.push(`${name}${(await isCovered()) ? ' is covered' : ''}`);
  }
  expect(seen).toContain('Open Arm 1');
  expect(seen.filter((one) => one.endsWith('is covered'))).toEqual([]);
});

test('several groups go to the selected robots; what is replaced and what does not fit is said before', async ({
  page,
  url,
}) => {
  await at(page, url, 'Fleet');
  await page.getByRole('checkbox', { name: 'Select Hexapod' }).check();
  await page.getByRole('button', { name: 'Download …' }).click();
  const dialog = page.getByRole('dialog', { name: 'Download to 3 robots' });
  const groups = dialog.getByRole('list', { name: 'Groups of the library' });
  await groups.getByRole('checkbox', { name: 'Nod' }).check();
  await groups.getByRole('checkbox', { name: 'Turn around' }).check();
  await expect(groups.getByRole('textbox', { name: 'Slot for Nod' })).toHaveValue('21');
  await expect(groups.getByText('Replaces what slot 4 holds on Arm 1 and Arm 2.')).toBeVisible();
  await expect(dialog.getByRole('button', { name: 'Download 2 groups to 3 robots' })).toBeEnabled();
  await groups.getByRole('checkbox', { name: 'Crawl' }).check();
  await expect(groups.getByText(/Does not fit these boards, which do not get it/)).toBeVisible();
  await groups.getByRole('textbox', { name: 'Slot for Crawl' }).fill('21');
  await page.keyboard.press('Enter');
  await expect(groups.getByText('Slot 21 is chosen twice.').first()).toBeVisible();
  await expect(dialog.getByRole('button', { name: 'Download 3 groups' })).toBeDisabled();
  await groups.getByRole('checkbox', { name: 'Crawl' }).uncheck();
  await dialog.getByRole('button', { name: 'Download 2 groups to 3 robots' }).click();
  await expect(dialog).toHaveCount(0);
});

test('the dashboard of a gateway with a fleet leads to its page, and that page back', async ({
  page,
  url,
}) => {
  await at(page, url, 'Owner of a shared robot, question');
  await expect(page.getByRole('link', { name: 'All robots' })).toHaveAttribute('href', './fleet.html');
  await at(page, url, 'Fleet');
  await expect(page.getByRole('link', { name: 'This gateway’s robot' })).toHaveAttribute('href', './');
});

test('a robot is driven: a slider moves it, STOP is beside it, and Esc stops all', async ({ page, url }) => {
  await at(page, url, 'Fleet');
  await page.getByRole('button', { name: 'Drive Arm 1' }).click();
  const panel = page.getByRole('dialog', { name: 'Drive Arm 1' });
  await expect(panel.getByText('You drive')).toBeVisible();
  const slider = panel.getByRole('slider', { name: 'Servo 2 position' });
  await expect(slider).toHaveAttribute('aria-valuetext', '1380 µs, commanded');
  await slider.focus();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Shift+ArrowRight');
  await expect(slider).toHaveAttribute('aria-valuetext', '1490 µs, commanded');
  await expect(panel.getByRole('slider', { name: 'Servo 6 position' })).toHaveAttribute(
    'aria-valuetext',
    'Unknown; the first move may be slow',
  );
  await panel.getByRole('button', { name: 'Stop Arm 1' }).click();
  await expect(page.getByText('1 robot stopped')).toBeVisible();
  await page.keyboard.press('Escape');
  await expect(page.getByText('8 robots stopped')).toBeVisible();
});

test('who drives is named where the lease is not free', async ({ page, url }) => {
  await at(page, url, 'Fleet, one driven by another person');
  const panel = page.getByRole('dialog', { name: 'Drive Arm 2' });
  await expect(panel.getByText('Request sent to Anna')).toBeVisible();
  await expect(panel.getByRole('slider', { name: 'Servo 1 position' })).toHaveAttribute(
    'aria-disabled',
    'true',
  );
  await panel.getByRole('button', { name: 'Close' }).click();
  await expect(panel).toHaveCount(0);
});

test('why a robot did not resume is said where it was asked', async ({ page, url }) => {
  await at(page, url, 'Fleet, one that does not resume');
  const panel = page.getByRole('dialog', { name: 'Drive Arm 4' });
  await panel.getByRole('button', { name: 'Resume' }).click();
  await expect(panel.getByText('STOP was pressed after this was requested.')).toBeVisible();
  await at(page, url, 'Fleet, one that is refused');
  await panel.getByRole('button', { name: 'Resume' }).click();
  await expect(panel.getByText('The gateway is being updated.')).toBeVisible();
});

test('what does not work is said in words', async ({ page, url }) => {
  await at(page, url, 'Fleet, one not reached');
  await expect(page.getByText('7 of 8 stopped. Not reached: Arm 6.')).toBeVisible();
  await at(page, url, 'Fleet, no robots');
  await expect(page.getByText('No robots yet')).toBeVisible();
  await expect(page.getByText('No robot needs a person')).toHaveCount(0);
  await at(page, url, 'Fleet, nothing heard yet');
  await expect(page.getByText('Nothing has been heard of the robots yet.')).toBeVisible();
  await expect(page.getByText('No robots yet')).toHaveCount(0);
  await at(page, url, 'Fleet, broker lost');
  await expect(page.getByText('The broker cannot be reached.')).toBeVisible();
});
