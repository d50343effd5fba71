// Writes what people have of the present version into a folder beside this file, by using the product as a person does: `npm run keep -- NAME`.
// The fleet's messages are written by backend/tests/keep_fleet.py. README.md names each file; tests of every later version open them.

import { cpSync, mkdirSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import type { APIResponse, BrowserContext, Page } from '@playwright/test';
import { metronome } from '#shared/testing/wav.ts';
import { python } from '../../scripts/python.mjs';
import { at, mustRun } from '../../scripts/steps.mjs';
import {
  anotherBrowser,
  dashboardOf,
  ONCE_BACK,
  ready,
  READY,
  type Dashboard,
} from '../fixtures/dashboard.ts';
import { startGateway } from '../fixtures/gateway.ts';
import { captureGroup, downloadGroup } from '../fixtures/group.ts';
import { libraryOf } from '../fixtures/library.ts';
import { firstInvitation } from '../fixtures/people.ts';
import { createPtyBoard, type PtyBoard } from '../fixtures/ptyBoard.ts';
import { simulatorArgs, SLOW_FLASH } from '../fixtures/robot.ts';
import { robotDialogOf } from '../fixtures/robotDialog.ts';
import { bundlePort, createRobotInPage } from '../fixtures/robotInPage.ts';
import { startStaticServer } from '../fixtures/staticServer.ts';
import { expect, poll, test } from '../fixtures/test.ts';
import { timelineOf } from '../fixtures/timeline.ts';

const folder = at(`e2e/kept/${process.env.KEEP}`);
/** A relative path, because the gateway stores it. */
const BOARD_FOLDER = 'build/kept';
const SOUND = metronome({ bpm: 240, firstMs: 50, lengthMs: 300 });

// The second one begins only where the first one has written its files.
test.describe.configure({ mode: 'serial' });

function writeJson(name: string, value: unknown): void {
  mkdirSync(folder, { recursive: true });
  writeFileSync(path.join(folder, name), `${JSON.stringify(value, null, 2)}\n`);
}

/** The types of Playwright leave out the databases. */
interface State {
  readonly origins: readonly [{ readonly localStorage: unknown; readonly indexedDB: unknown }];
}

/** What the browser holds for the page, without its address. */
async function profileOf(context: BrowserContext) {
  const { origins } = (await context.storageState({ indexedDB: true })) as unknown as State;
  const [{ localStorage, indexedDB }] = origins;
  return { localStorage, indexedDB };
}

async function save(name: string, page: Page, press: () => Promise<void>): Promise<void> {
  const downloading = page.waitForEvent('download');
  await press();
  await (await downloading).saveAs(path.join(folder, name));
}

/** A robot of one's own, with its limits, zero points and battery. */
async function describeRobot(dashboard: Dashboard, name: string): Promise<void> {
  const robots = robotDialogOf(dashboard);
  await robots.opener.click();
  await robots.button('Add Arm, 6 servos').click();
  await robots.button('Edit').click();
  await robots.dialog.getByRole('textbox', { name: 'Name of the robot' }).fill(name);
  await robots.dialog.getByRole('textbox', { name: 'Name of the robot' }).press('Enter');
  await dashboard.type(robots.cell('Lowest', 'Elbow'), 700);
  await dashboard.type(robots.cell('Highest', 'Elbow'), 2300);
  await dashboard.type(robots.cell('Home', 'Elbow'), 1450);
  await dashboard.type(robots.cell('Trim', 'Elbow'), 12);
  await robots.dialog.getByRole('checkbox', { name: 'Reversed of Elbow' }).check();
  await robots.button('Close').click();
  await expect(robots.opener).toHaveAccessibleName(`Robot: ${name}`);
  await dashboard.feedBy('2S pack', { warn: 7100, alarm: 6700 });
}

/** A pose, a button with a key that goes there, and a pad with a feel of its own. */
async function makePoseAndButton(dashboard: Dashboard): Promise<void> {
  const { page } = dashboard;
  await page.getByRole('radio', { name: 'Poses' }).check();
  await dashboard.type(dashboard.target(1), 1800);
  await dashboard.button('Capture pose').click();
  const field = page.getByRole('textbox', { name: /^Name of Pose/ });
  await field.fill('Reach');
  await field.press('Enter');
  await page.getByRole('switch', { name: 'Use as rest pose' }).check();
  await dashboard.button('Make a button').click();
  await page.getByRole('radio', { name: 'Buttons' }).check();
  await page.getByRole('switch', { name: 'Edit buttons' }).check();
  await page
    .getByRole('list', { name: 'Buttons' })
    .getByRole('button', { name: /^Reach/ })
    .click();
  await dashboard.button('Set a key').click();
  await page.keyboard.press('g');
  await page.getByRole('switch', { name: 'Edit buttons' }).uncheck();
  await page.getByRole('radio', { name: 'Animate' }).check();
  await page.getByRole('radio', { name: 'Keys and pad' }).check();
  await page.getByRole('slider', { name: 'Dead zone' }).press('End');
}

/** Groups as a library has them: with versions, tags and names of all languages, and one that was deleted. The first one is open. */
async function fillLibrary(dashboard: Dashboard): Promise<void> {
  const library = libraryOf(dashboard.page);
  await captureGroup(dashboard, [1000, 1600, 1300], 200);
  await library.call('Wave');
  await library.show();
  await library.more('Wave');
  await library.write('Name of the version', 'First try');
  await expect(library.button('Go back to First try')).toBeVisible();
  await library.write('Tags of Wave', 'show, short');
  for (const name of ['鞠躬 🤖', 'Mistake']) {
    await library.button('New group').click();
    await expect(dashboard.frames).toHaveCount(0);
    await captureGroup(dashboard, [1200]);
    await library.call(name);
    await library.show();
  }
  await library.more('Mistake');
  await library.button('Delete').click();
  await expect(library.button('Open Mistake')).toBeHidden();
  await library.open('Wave');
  await expect(dashboard.frames).toHaveCount(3);
  await downloadGroup(dashboard, 5, 1200);
}

/** Choices that belong to the browser. */
async function setPage({ page, link }: Dashboard): Promise<void> {
  await page.getByRole('radio', { name: 'Drive', exact: true }).check();
  await page.getByRole('radio', { name: '°', exact: true }).check();
  await page.getByRole('button', { name: /^Appearance: / }).click();
  await link.click();
  await page.getByRole('textbox', { name: 'Name of this board' }).fill('Workbench');
  await page.keyboard.press('Enter');
  await page.getByRole('button', { name: 'Close', exact: true }).click();
}

async function addSound({ page }: Dashboard): Promise<void> {
  await timelineOf(page).tools.getByRole('button', { name: 'More', exact: true }).click();
  const choosing = page.waitForEvent('filechooser');
  await page.getByRole('menuitem', { name: 'Add sound …' }).click();
  await (await choosing).setFiles({ name: 'clicks.wav', mimeType: 'audio/wav', buffer: Buffer.from(SOUND) });
  await expect(page.getByRole('group', { name: 'Sound track' })).toContainText('clicks.wav');
}

/** Each kind of file that the page saves. */
async function saveFiles(dashboard: Dashboard): Promise<void> {
  const { page, button } = dashboard;
  await page.getByRole('radio', { name: 'Animate' }).check();
  await page.getByRole('radio', { name: 'Action group', exact: true }).check();
  await button('Files').click();
  await page.getByRole('radio', { name: 'Servodeck', exact: true }).check();
  await save('group.json', page, () => button('Save Wave.json').click());
  await button('Close').click();
  await button('Library').click();
  await save('library.json', page, () => libraryOf(page).button('Export').click());
  await libraryOf(page).close();
  await robotDialogOf(dashboard).opener.click();
  await save('robot.json', page, () => robotDialogOf(dashboard).button('Export').click());
  await robotDialogOf(dashboard).button('Close').click();
  await button('Show the log').click();
  await save('log.txt', page, () => button('Save log').click());
  await button('Hide the log').click();
}

test('a browser that has no gateway', async ({ page, context }) => {
  const files = await startStaticServer();
  const robot = await createRobotInPage(page, files.url, await bundlePort(), {});
  await robot.open(page);
  const dashboard = await ready(page);
  await describeRobot(dashboard, 'Desk arm');
  await fillLibrary(dashboard);
  await addSound(dashboard);
  await makePoseAndButton(dashboard);
  await saveFiles(dashboard);
  await setPage(dashboard);
  writeJson('browser.json', await profileOf(context));
  await files.end();
});

/** A gateway and its owner, Olga. */
interface AtGateway {
  readonly url: string;
  readonly context: BrowserContext;
  ask(method: string, where: string, data?: object): Promise<unknown>;
}

async function answerOf(response: APIResponse): Promise<unknown> {
  expect(response.ok(), `${response.url()}: ${await response.text()}`).toBe(true);
  return response.status() === 204 ? null : response.json();
}

async function credentialOf(context: BrowserContext): Promise<string> {
  const [cookie] = await context.cookies();
  return cookie?.value ?? '';
}

/** Somebody comes in by an invitation, on a device of their own. */
async function pair({ url, context, ask }: AtGateway, role: string, name: string): Promise<string> {
  const { link } = (await ask('POST', 'invites', { role, name })) as { link: string };
  const device = await context.browser()!.newContext();
  const [, secret] = link.split('#pair=');
  await answerOf(
    await device.request.post(`${url}/api/v1/pair`, { headers: { origin: url }, data: { secret } }),
  );
  const credential = await credentialOf(device);
  await device.close();
  return credential;
}

/** Who comes in by which credential, as whom; and those who do not any more. */
async function letIn(gateway: AtGateway) {
  const { context, ask } = gateway;
  const token = async (name: string, role: string, expiresInDays?: number): Promise<string> =>
    ((await ask('POST', 'tokens', { name, role, expiresInDays })) as { token: string }).token;
  const { link } = (await ask('POST', 'stop-links', { name: 'On the robot' })) as { link: string };
  const people = [
    { name: 'Olga', role: 'owner', credential: await credentialOf(context) },
    { name: 'Dan', role: 'driver', credential: await pair(gateway, 'driver', 'Dan') },
    { name: 'Vera', role: 'viewer', credential: await pair(gateway, 'viewer', 'Vera') },
    { name: 'Wave at noon', role: 'driver', credential: await token('Wave at noon', 'driver') },
    { name: 'Display', role: 'viewer', credential: await token('Display', 'viewer', 3650) },
    { name: 'On the robot', role: 'stopper', credential: link.split('#stop=')[1] ?? '' },
  ];
  const revoked = [await pair(gateway, 'driver', 'Ex'), await token('Old script', 'driver')];
  const listed = (await ask('GET', 'people')) as { people: { id: string; name: string }[] };
  for (const { id, name } of listed.people)
    if (['Ex', 'Old script'].includes(name)) await ask('DELETE', `people/${id}`);
  return { people, revoked };
}

interface Listed {
  readonly documents: readonly { readonly id: string }[];
}

interface Person {
  readonly id: string;
  readonly kind: string;
  readonly name: string;
  readonly role: string;
  readonly pairedAtMs: number;
}
interface Status {
  readonly board: string;
  readonly port: { readonly device: string; readonly status: string };
}

/** What the gateway says of everything that it holds, by address; not what changes by itself. */
async function answersOf({ ask }: AtGateway): Promise<Record<string, unknown>> {
  const answers: Record<string, unknown> = {};
  const note = async <T>(where: string): Promise<T> => (answers[where] = await ask('GET', where)) as T;
  const { documents } = await note<Listed>('library');
  for (const { id } of documents) {
    await note(`library/${id}`);
    const versions = await note<readonly { id: string }[]>(`library/${id}/versions`);
    for (const version of versions) await note(`library/${id}/versions/${version.id}`);
  }
  for (const where of ['poses', 'audit?limit=200']) await note(where);
  const { people } = (await ask('GET', 'people')) as { people: readonly Person[] };
  answers.people = {
    people: people.map(({ id, kind, name, role, pairedAtMs }) => ({ id, kind, name, role, pairedAtMs })),
  };
  const { board, port } = (await ask('GET', 'status')) as Status;
  answers.status = { board, port: { device: port.device, status: port.status } };
  return answers;
}

test('a gateway, the browser of its owner, and a backup', async ({ browser, scratch }) => {
  rmSync(at(BOARD_FOLDER), { recursive: true, force: true });
  mkdirSync(at(BOARD_FOLDER), { recursive: true });
  const board = await createPtyBoard(
    at(BOARD_FOLDER),
    simulatorArgs({ board: 'openarm-new', ...SLOW_FLASH }),
  );
  await board.plugIn();
  const data = path.join(scratch, 'data');
  const { url, said, end } = await startGateway({ board: 'unknown', lan: true, folder: data });
  const { hash } = new URL((await firstInvitation({ said })).link);
  const context = await anotherBrowser(browser, { locale: 'en-GB', viewport: { width: 1440, height: 900 } });
  const page = await context.newPage();
  await page.goto(`${url}/${hash}`);
  await page.getByRole('textbox', { name: 'Your name' }).fill('Olga');
  await page.getByRole('button', { name: 'Continue' }).click();
  const gateway: AtGateway = {
    url,
    context,
    ask: async (method, where, wanted) =>
      answerOf(
        await page.request.fetch(`${url}/api/v1/${where}`, {
          method,
          headers: { origin: url },
          ...(wanted === undefined ? {} : { data: wanted }),
        }),
      ),
  };
  await gateway.ask('PUT', 'port', { device: board.device });
  const dashboard = dashboardOf(page);
  await dashboard.takeFor('uHand 2.0 / OpenArm').click();
  await ready(page);

  await describeRobot(dashboard, 'Class arm');
  await fillLibrary(dashboard);
  await breakSlot(dashboard, board);
  await makePoseAndButton(dashboard);
  await setPage(dashboard);
  const { people, revoked } = await letIn(gateway);
  await poll(async () => (await context.storageState()).origins[0]?.localStorage).toContainEqual({
    name: 'servodeck.unkept',
    value: '[]',
  });
  await backUp(data);
  writeJson('gateway.json', { people, revoked, answers: await answersOf(gateway) });

  await end();
  cpSync(data, path.join(folder, 'data'), { recursive: true });
  await changeUnsent(dashboard);
  writeJson('owner.json', await profileOf(context));
  await context.close();
  await board.unplug();
});

/** The cable is pulled in the middle of a download. */
async function breakSlot(dashboard: Dashboard, board: PtyBoard): Promise<void> {
  await dashboard.type(dashboard.slot, 6);
  await dashboard.button('Download').click();
  await expect(dashboard.progress).toHaveAttribute('aria-valuetext', '0 of 3 frames');
  await board.unplug();
  await expect(dashboard.link).not.toHaveText(READY);
  await board.plugIn();
  await expect(dashboard.link).toHaveText(READY, ONCE_BACK);
  await dashboard.resume.click();
  await expect(dashboard.board).toContainText('Its download did not finish.');
}

/** The gateway runs meanwhile. */
async function backUp(data: string): Promise<void> {
  const file = path.join(folder, 'backup.zip');
  await mustRun('write a backup', python, ['-m', 'servodeck', 'backup', file, '--data', data, '--force']);
}

/** The browser holds what the gateway does not have yet. */
async function changeUnsent(dashboard: Dashboard): Promise<void> {
  const { page } = dashboard;
  await page.getByRole('radio', { name: 'Animate' }).check();
  await page.getByRole('radio', { name: 'Action group', exact: true }).check();
  await libraryOf(page).call('Wave, changed late');
  await poll(async () => JSON.stringify(await page.context().storageState())).toContain('Wave, changed late');
}
