// What people have of every version there has been (e2e/kept): a gateway on its data folder and the browser of its owner, together.
// The owner is let in, sees what there was, and what the browser had not sent yet arrives. Nothing moves.

import { cpSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { at } from '../../scripts/steps.mjs';
import { ready } from '../fixtures/dashboard.ts';
import { libraryOf } from '../fixtures/library.ts';
import { createPtyBoard } from '../fixtures/ptyBoard.ts';
import { robotDialogOf } from '../fixtures/robotDialog.ts';
import { expect, poll, test } from '../fixtures/test.ts';

const FOLDER = at('e2e/kept');
const VERSIONS = readdirSync(FOLDER, { withFileTypes: true }).flatMap((entry) =>
  entry.isDirectory() ? [entry.name] : [],
);
const HARMLESS = ['stop', 'readBattery', 'readVersion', 'readPositions', 'readAllPositions'];

interface Kept {
  readonly people: readonly { readonly credential: string }[];
  readonly answers: {
    readonly status: { readonly board: string; readonly port: { readonly device: string } };
  };
}
interface Profile {
  readonly localStorage: { name: string; value: string }[];
}

for (const version of VERSIONS)
  test(`version ${version}: its owner is let in, finds everything, and sends what was not sent yet`, async ({
    newGateway,
    browser,
    scratch,
  }) => {
    const textOf = (name: string): string => readFileSync(path.join(FOLDER, version, name), 'utf8');
    const { people, answers } = JSON.parse(textOf('gateway.json')) as Kept;
    const { board: family, port } = answers.status;
    const board = await createPtyBoard(scratch, ['--board', family]);
    await board.plugIn();
    // Tests may run side by side: each has its board under another name.
    const renamed = (name: string): string => textOf(name).replaceAll(port.device, board.device);
    const data = path.join(scratch, 'data');
    cpSync(path.join(FOLDER, version, 'data'), data, { recursive: true });
    for (const name of ['remembered.json', 'slots.json'])
      writeFileSync(path.join(data, name), renamed(`data/${name}`));
    const { localStorage } = JSON.parse(renamed('owner.json')) as Profile;
    const { url } = await newGateway({ board: '', lan: true, folder: data });
    const cookie = { name: `servodeck_${new URL(url).port}`, value: people[0]?.credential ?? '', url };
    const context = await browser.newContext({
      storageState: { cookies: [], origins: [{ origin: url, localStorage }] },
    });
    await context.addCookies([cookie]);
    const page = await context.newPage();
    await page.goto(url);
    const dashboard = await ready(page);

    await expect(dashboard.bar).toContainText('Workbench');
    await expect(robotDialogOf(dashboard).opener).toHaveAccessibleName('Robot: Class arm');
    await page.getByRole('radio', { name: 'Animate' }).check();
    const library = libraryOf(page);
    await expect(library.groupName).toHaveValue('Wave, changed late');
    await expect(dashboard.frames).toHaveCount(3);
    await page.getByRole('radio', { name: 'Poses' }).check();
    await expect(page.getByRole('textbox', { name: 'Name of Reach' })).toBeVisible();
    await page.getByRole('radio', { name: 'Action group', exact: true }).check();
    await dashboard.button('Slots').click();
    await expect(page.getByRole('option', { name: /^Slot 5: Wave/ })).toBeVisible();
    await expect(page.getByRole('option', { name: /^Slot 6: Broken/ })).toBeVisible();
    await dashboard.button('Close').click();
    await library.show();
    await expect(library.card('鞠躬 🤖')).toContainText('1 frame');
    await expect(library.dialog).not.toContainText('Not all changes');
    const texts = (): Promise<string> =>
      page.request.get(`${url}/api/v1/library`, { headers: { origin: url } }).then((answer) => answer.text());
    await poll(texts).toContain('Wave, changed late');
    const heard = (await board.bus()).map(({ command }) => command.kind);
    expect(HARMLESS).toEqual(expect.arrayContaining(heard));
    expect(heard).toContain('stop');
    await context.close();
    await board.unplug();
  });
