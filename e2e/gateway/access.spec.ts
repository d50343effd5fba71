// A gateway on the network: who comes in and how, what each may do, and that a person who looks can stop the robot.

import { readFile } from 'node:fs/promises';
import { ofKind, type Bus } from '../fixtures/bus.ts';
import { ready } from '../fixtures/dashboard.ts';
import { firstInvitation, guest, newDevice, pairCardOf, peopleOf } from '../fixtures/people.ts';
import { expect, poll, test } from '../fixtures/test.ts';

const stops = async (bus: Bus): Promise<number> => ofKind(await bus(), 'stop').length;

test('an owner comes in by the terminal’s link, lets a viewer in, who stops, revokes it, and sees what happened', async ({
  newGateway,
  ptyBoard,
  browser,
}) => {
  const gateway = await newGateway({ serial: ptyBoard.device, lan: true });
  const { link } = await firstInvitation(gateway);
  const owner = await guest(browser, link);
  expect(owner.page.url()).not.toContain('#');
  const people = peopleOf(owner);
  await people.opener.click();
  const invitation = await people.invite('viewer', 'Ben');

  const ben = await guest(browser, invitation.link);
  await expect(people.person('Ben')).toContainText('Here now');
  await expect(peopleOf(ben).opener).toBeHidden();
  const before = await stops(ptyBoard.bus);
  await ben.stop.click();
  await poll(() => stops(ptyBoard.bus)).toBeGreaterThanOrEqual(before + 3);
  // The gateway has just opened the port: what another client set in motion before may go on.
  await expect(ben.status).toContainText('The robot may keep moving for up to');
  await expect(owner.status).toContainText('Stopped by Ben');

  const used = await newDevice(browser, invitation.link);
  await expect(pairCardOf(used).problem).toContainText('used already');

  await people.person('Ben').getByRole('button', { name: 'Revoke' }).click();
  await owner.page
    .getByRole('alertdialog', { name: 'Revoke Ben?' })
    .getByRole('button', { name: 'Revoke' })
    .click();
  await expect(pairCardOf(ben.page).title).toBeVisible();
  await expect(pairCardOf(ben.page).problem).toContainText('not paired any more');
  await expect(people.person('Ben')).toBeHidden();

  const acts = await people.showActs();
  await expect(acts.first()).toContainText('Revoked Ben');
  await expect(acts.filter({ hasText: 'Stopped the robot' })).toContainText('Ben');
  const saved = owner.page.waitForEvent('download');
  await people.dialog.getByRole('button', { name: 'Export' }).click();
  expect(await readFile(await (await saved).path(), 'utf8')).toMatch(
    /^at,until,act,who,whom,about,count\r\n/,
  );
  await people.dialog.getByRole('combobox', { name: 'Person' }).selectOption('Ben');
  await expect(acts).toHaveText([/Ben.*Stopped the robot/, /Ben.*Paired/]);
  await people.dialog.getByRole('tab', { name: 'What happened' }).press('ArrowLeft');
  await expect(people.dialog.getByRole('tab', { name: 'People' })).toBeFocused();
  await expect(acts.first()).toBeHidden();
});

test('people come in by the digits, one after the other, until five were wrong @exhaustive', async ({
  newGateway,
  ptyBoard,
  browser,
}) => {
  const gateway = await newGateway({ serial: ptyBoard.device, lan: true });
  const first = await firstInvitation(gateway);
  const address = first.link.replace(/#.*/, '');
  const ownerPage = await newDevice(browser, address);
  await pairCardOf(ownerPage).type('Anna', first.code);
  const owner = await ready(ownerPage);
  const people = peopleOf(owner);
  await people.opener.click();
  await expect(people.person('Anna')).toContainText('You');
  const { code } = await people.invite('driver', '');

  const benPage = await newDevice(browser, address);
  await pairCardOf(benPage).type('Ben', code);
  const ben = await ready(benPage);
  await expect(people.person('Ben')).toContainText('Here now');
  await ben.type(ben.target(1), 1600);
  await poll(async () => ofKind(await ptyBoard.bus(), 'move').length).toBeGreaterThan(0);

  const next = people.dialog.getByText(/^\d{4} \d{4}$/);
  await expect(next).not.toHaveText(code);
  const right = await next.innerText();
  const wrong = right === '1234 5678' ? '8765 4321' : '1234 5678';
  const guesser = pairCardOf(await newDevice(browser, address));
  for (let attempt = 1; attempt < 5; attempt++) {
    await guesser.type('Eve', wrong);
    await expect(guesser.problem).toContainText('is wrong');
  }
  await guesser.type('Eve', wrong);
  await expect(guesser.problem).toContainText('codes are no longer accepted');
  await guesser.type('Eve', right);
  await expect(guesser.problem).toContainText('codes are no longer accepted');
});

test('the code that is shown is one of the role that is chosen, also when that changes @exhaustive', async ({
  newGateway,
  ptyBoard,
  browser,
}) => {
  const gateway = await newGateway({ serial: ptyBoard.device, lan: true });
  const owner = await guest(browser, (await firstInvitation(gateway)).link);
  const people = peopleOf(owner);
  await people.opener.click();
  const { link } = await people.invite('viewer', '');
  await people.dialog.getByRole('combobox', { name: 'Role', exact: true }).selectOption('driver');
  const shown = people.dialog.getByText(/#pair=/);
  await expect(shown).not.toHaveText(link);
  await guest(browser, await shown.innerText(), { name: 'Ben' });
  await expect(people.person('Ben').getByRole('combobox')).toHaveValue('driver');
});

test('a stop-only link has one button, which stops the robot', async ({ newGateway, ptyBoard, browser }) => {
  const gateway = await newGateway({ serial: ptyBoard.device, lan: true });
  const owner = await guest(browser, (await firstInvitation(gateway)).link);
  const people = peopleOf(owner);
  await people.opener.click();
  await people.dialog.getByRole('textbox', { name: 'Purpose' }).fill('On the robot');
  await people.dialog.getByRole('button', { name: 'Make a stop-only QR code' }).click();
  const link = await people.dialog.getByText(/#stop=/).innerText();

  const passer = await newDevice(browser, link);
  await expect(passer.getByRole('button')).toHaveCount(1);
  const before = await stops(ptyBoard.bus);
  await passer.getByRole('button', { name: 'Stop' }).click();
  await expect(passer.getByRole('status')).toContainText('Stop was sent');
  // The last one leaves the wire a moment before the simulated board has written it down.
  await poll(() => stops(ptyBoard.bus)).toBeGreaterThanOrEqual(before + 3);
  await expect(owner.status).toContainText('Stopped');
  await passer.reload();
  await expect(passer.getByRole('heading', { name: 'Stop the robot' })).toBeVisible();
});

test('a person who revokes a script is asked what becomes of the group that it let go on @exhaustive', async ({
  newGateway,
  ptyBoard,
  browser,
  request,
}) => {
  const gateway = await newGateway({ serial: ptyBoard.device, lan: true });
  const owner = await guest(browser, (await firstInvitation(gateway)).link, { name: 'Olga' });
  const people = peopleOf(owner);
  const dialog = owner.page.getByRole('alertdialog', { name: 'Revoke Dance?' });
  const shown = people.dialog.getByText(/^[0-9a-f]{16}\./);
  let token = '';
  async function danceAlone(): Promise<void> {
    await people.dialog.getByRole('textbox', { name: 'Purpose' }).fill('Dance');
    await people.dialog.getByRole('button', { name: 'Make a token' }).click();
    // The one before stands there until this one has come.
    if (token !== '') await expect(shown).not.toHaveText(token);
    token = await shown.innerText();
    const run = await request.post(`${new URL(owner.page.url()).origin}/api/slots/9/run`, {
      headers: { authorization: `Bearer ${token}` },
      data: { times: 2, continueForMs: 600_000, take: false },
    });
    expect(run.ok()).toBe(true);
    await people.person('Dance').getByRole('button', { name: 'Revoke' }).click();
    await expect(dialog).toContainText('Slot 9, which was started to run without its driver, still runs');
  }
  await people.opener.click();
  await danceAlone();
  const before = await stops(ptyBoard.bus);
  await dialog.getByRole('button', { name: 'Revoke, let it run' }).click();
  await expect(people.person('Dance')).toBeHidden();
  expect(await stops(ptyBoard.bus)).toBe(before);

  await danceAlone();
  await dialog.getByRole('button', { name: 'Revoke and stop' }).click();
  await expect(people.person('Dance')).toBeHidden();
  await poll(() => stops(ptyBoard.bus)).toBeGreaterThanOrEqual(before + 3);
  await expect(owner.status).toContainText('Stopped by Olga');
});
