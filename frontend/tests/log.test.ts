// Under the hood: the packet log says in words and bytes what went over the link, is saved as a file, and sends by hand what
// the board may get.

import type { Page } from './harness/page.ts';
import { lastTarget } from '../../e2e/fixtures/bus.ts';
import { expect, poll, test, type Dashboard } from './harness/test.ts';
import { advance } from './harness/time.ts';

test('the log shows packets in words and in bytes, both ways, and can be thinned out', async ({
  dashboard,
  robot,
  page,
}) => {
  await dashboard.button('Show the log').click();
  await dashboard.type(dashboard.target(1), 2000);
  await poll(() => lastTarget(robot.bus, 1)).toBe(2000);
  await expect(dashboard.log).toContainText('Move 1 → 2000 in 2000 ms');
  await expect(dashboard.log).toContainText('55 55 08 03 01 D0 07 01 D0 07');
  await expect(dashboard.log).toContainText('Read the battery');
  await expect(dashboard.log).toContainText('Battery 7.50 V');
  await expect(dashboard.log).toContainText('55 55 04 0F 4C 1D');

  await page.getByRole('checkbox', { name: 'Battery' }).uncheck();
  await expect(dashboard.log).not.toContainText('Battery 7.50 V');
  await expect(dashboard.log).toContainText('Move 1 → 2000');
  await page.getByRole('searchbox', { name: 'Find in the log' }).fill('link ready');
  await expect(dashboard.log).not.toContainText('Move 1 → 2000');
  await expect(dashboard.log).toContainText('Link ready');
  await page.getByRole('searchbox', { name: 'Find in the log' }).fill('');
  await dashboard.button('Clear log').click();
  await expect(dashboard.log).not.toContainText('Move 1 → 2000');
});

test('the log is saved as text that a person can read', async ({ dashboard, robot, page }) => {
  await dashboard.button('Show the log').click();
  await dashboard.type(dashboard.target(1), 2000);
  await poll(() => lastTarget(robot.bus, 1)).toBe(2000);
  const download = page.waitForEvent('download');
  await dashboard.button('Save log').click();
  const file = await download;
  expect(file.suggestedFilename()).toMatch(/^servodeck-doc-\d{4}-\d\d-\d\dT\d{4}\.txt$/u);
  const text = await file.text();
  expect(text).toMatch(/^servodeck-log: 1\nboard: doc\nport: .+\n/u);
  expect(text).toMatch(/^\d+\.\d{3} {2}= {2}opened {2}# Link ready$/mu);
  expect(text).toMatch(/^\d+\.\d{3} {2}> {2}55 55 08 03 01 D0 07 01 D0 07 {2}# Move 1 → 2000 in 2000 ms$/mu);
});

test('the folded log says a stop before anything that follows it', async ({ dashboard, page }) => {
  await dashboard.type(dashboard.target(1), 2000);
  const latest = page.getByRole('button', { name: 'Show the log' });
  await expect(latest).toContainText('Move 1 → 2000');
  const said = await latest.evaluateHandle((strip) => {
    const texts: string[] = [];
    const note = (): void => void texts.push(strip.textContent);
    new MutationObserver(note).observe(strip, { characterData: true, childList: true, subtree: true });
    return texts;
  });
  await dashboard.drag(2, 0.3);
  // It is on its way.
  await advance(300);
  await dashboard.stop.click();
  await expect(dashboard.resume).toBeVisible();
  await expect(dashboard.estimate(2)).toBeVisible();
  await expect(latest).toContainText('Stopped from here');
  const texts = await said.evaluate((all) => [...all]);
  const first = texts.findIndex((text) => text.includes('Stopped from here'));
  expect(texts.slice(first).filter((text) => !text.includes('Stopped from here'))).toEqual([]);
});

function typed({ button, field }: Dashboard, page: Page) {
  const form = page.getByRole('form', { name: 'Send a packet' });
  return {
    form,
    packet: field('Packet in hex'),
    consent: page.getByRole('switch', { name: 'I know what this does' }),
    send: button('Send packet'),
  };
}

test('a packet by hand is explained, and goes only behind the switch', async ({ dashboard, robot, page }) => {
  await dashboard.button('Show the log').click();
  const { form, packet, consent, send } = typed(dashboard, page);
  await packet.fill('55 55 05 06 08 02');
  await expect(form).toContainText('1 byte missing');
  await expect(send).toBeDisabled();
  await packet.fill('55 55 05 06 08 02 00');
  await expect(form).toContainText('Run slot 8, 2 times');
  await expect(send).toBeDisabled();
  await consent.check();
  await packet.press('Enter');
  await poll(async () => (await robot.bus()).map(({ command }) => command)).toContainEqual({
    kind: 'run',
    slot: 8,
    times: 2,
  });

  await dashboard.button('Hide the log').click();
  await dashboard.button('Show the log').click();
  await expect(consent).not.toBeChecked();
});

test('the battery is asked by hand, an erase is refused', async ({ dashboard, robot, page }) => {
  await dashboard.button('Show the log').click();
  const { form, packet, consent, send } = typed(dashboard, page);
  await consent.check();
  const questions = async (): Promise<number> =>
    (await robot.bus()).filter(({ command }) => command.kind === 'readBattery').length;
  const before = await questions();
  await packet.fill('55 55 02 0F');
  await send.click();
  await poll(questions).toBeGreaterThan(before);

  await packet.fill('55 55 03 08 00');
  await expect(form).toContainText('use the Board panel');
  await expect(send).toBeDisabled();
  await packet.press('Enter');
  await packet.fill('55 55 02 06');
  await expect(form).toContainText('bytes of earlier packets');
  await expect(send).toBeDisabled();
  const kinds = new Set((await robot.bus()).map(({ command }) => command.kind));
  expect(kinds).not.toContain('erase');
});
