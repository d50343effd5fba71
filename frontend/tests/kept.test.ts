// What browsers hold of every version there has been (e2e/kept): the page opens with the same robot, groups and choices, and
// nothing moves because of them.

import { ofKind } from '../../e2e/fixtures/bus.ts';
import * as libraries from '../../e2e/fixtures/library.ts';
import * as robotDialog from '../../e2e/fixtures/robotDialog.ts';
import { filesDialogOf } from './filesDialog.ts';
import { createBrowserStore } from '../src/features/library/browserStore.ts';
import { storedFile } from '../src/state/fileStore.ts';
import { dashboardOf, expect, here, test, untilItHears } from './harness/test.ts';
import { advance } from './harness/time.ts';

const { libraryOf } = here(libraries);
const { robotDialogOf } = here(robotDialog);

interface Store {
  readonly name: string;
  readonly keyPath?: string;
  readonly keyPathArray?: string[];
  readonly records: readonly {
    readonly key?: string;
    readonly value?: unknown;
    /** Bytes in base64, as Playwright writes them. */
    readonly valueEncoded?: { readonly ta: { readonly b: string } };
  }[];
}

/** The format that `e2e/kept/keep.spec.ts` writes. */
interface Profile {
  readonly localStorage: readonly { readonly name: string; readonly value: string }[];
  readonly indexedDB: readonly {
    readonly name: string;
    readonly version: number;
    readonly stores: readonly Store[];
  }[];
}

const VERSIONS = Object.keys(import.meta.glob('../../e2e/kept/*/browser.json')).map(
  (file) => file.split('/').at(-2) ?? '',
);

const kept = async (version: string, name: string): Promise<Uint8Array> =>
  new Uint8Array(await (await fetch(`/e2e/kept/${version}/${name}`)).arrayBuffer());

const bytesOf = (base64: string): Uint8Array =>
  Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));

async function restore({ localStorage: texts, indexedDB: databases }: Profile): Promise<void> {
  for (const { name, value } of texts) localStorage.setItem(name, value);
  for (const { name, version, stores } of databases)
    await new Promise<void>((resolve, reject) => {
      const opening = indexedDB.open(name, version);
      opening.addEventListener('upgradeneeded', () => {
        for (const { name: store, keyPath, keyPathArray, records } of stores) {
          const path = keyPath ?? keyPathArray;
          const made = opening.result.createObjectStore(store, path === undefined ? {} : { keyPath: path });
          for (const { key, value, valueEncoded } of records)
            made.put(valueEncoded === undefined ? value : bytesOf(valueEncoded.ta.b), key);
        }
      });
      opening.addEventListener('success', () => {
        opening.result.close();
        resolve();
      });
      opening.addEventListener('error', () => reject(new Error(`the browser takes no ${name}`)));
    });
}

for (const version of VERSIONS)
  test.describe(`version ${version}`, () => {
    test('the page has all that its browser held', async ({ page, robot }) => {
      const profile = JSON.parse(new TextDecoder().decode(await kept(version, 'browser.json'))) as Profile;
      await restore(profile);
      window.portInPage.allow();
      await page.goto('/');
      const dashboard = dashboardOf(page);
      await untilItHears(dashboard);

      // The port tells the board, and the board the robot with its limits.
      await expect(dashboard.bar).toContainText('Workbench');
      const robots = robotDialogOf(dashboard);
      await expect(robots.opener).toHaveAccessibleName('Robot: Desk arm');
      await robots.opener.click();
      await robots.button('Edit').click();
      const elbow = { Lowest: '700', Highest: '2300', Home: '1450', Trim: '12' };
      for (const [column, value] of Object.entries(elbow))
        await expect(robots.cell(column, 'Elbow')).toHaveValue(value);
      await expect(robots.dialog.getByRole('checkbox', { name: 'Reversed of Elbow' })).toBeChecked();
      await robots.button('Close').click();
      await dashboard.button('Battery settings').click();
      await expect(page.getByRole('radio', { name: '2S pack' })).toBeChecked();
      await expect(dashboard.field('Warn at, in millivolts')).toHaveValue('7100');
      await dashboard.button('Close').click();

      await expect(page.getByRole('button', { name: 'Appearance: Dark' })).toBeVisible();
      await expect(dashboard.frames).toHaveCount(3);
      await expect(page.getByRole('group', { name: 'Sound track' })).toContainText('clicks.wav');
      await expect(dashboard.slot).toHaveValue('5');
      await expect(dashboard.board).toContainText('Holds this group, up to date.');

      await page.getByRole('radio', { name: 'Poses' }).check();
      await expect(page.getByRole('textbox', { name: 'Name of Reach' })).toHaveValue('Reach');
      await page
        .getByRole('list', { name: 'Poses' })
        .getByRole('button', { name: /^Reach/ })
        .click();
      await expect(page.getByRole('switch', { name: 'Use as rest pose' })).toBeChecked();
      await page.getByRole('radio', { name: 'Keys and pad' }).check();
      await expect(page.getByRole('slider', { name: 'Dead zone' })).toHaveValue('50');
      await page.getByRole('radio', { name: 'Buttons' }).check();
      await expect(page.getByRole('button', { name: 'Reach, key G' })).toBeVisible();
      await page.getByRole('radio', { name: 'Drive', exact: true }).check();
      await expect(page.getByRole('radio', { name: '°', exact: true })).toBeChecked();
      await page.getByRole('radio', { name: 'Animate' }).check();
      await page.getByRole('radio', { name: 'Action group', exact: true }).check();

      const library = libraryOf(page);
      await library.show();
      await expect(library.card('Wave')).toContainText('3 frames');
      await expect(library.card('鞠躬 🤖')).toContainText('1 frame');
      await library.more('Wave');
      await expect(library.button('Go back to First try')).toBeVisible();
      await expect(library.field('Tags of Wave')).toHaveValue('show, short');
      // A deleted group stays for 30 days; the clock of these tests is before that.
      await library.dialog.getByRole('switch', { name: 'Deleted' }).check();
      await library.card('Mistake').getByRole('button', { name: 'Restore' }).click();
      await library.dialog.getByRole('switch', { name: 'Deleted' }).uncheck();
      await library.open('Mistake');
      await expect(dashboard.frames).toHaveCount(1);

      await advance(30_000);
      const kinds = (await robot.bus()).map(({ command }) => command.kind);
      expect(kinds.filter((kind) => !HARMLESS.has(kind))).toEqual([]);
      await expectNothingLost(profile);
    });

    test('its files are opened', async ({ dashboard, page, robot }) => {
      const files = filesDialogOf(dashboard);
      await files.open({ name: 'group.json', content: await kept(version, 'group.json') });
      await files.file('group.json').getByRole('button', { name: 'Open Wave' }).click();
      await expect(dashboard.frames).toHaveCount(3);

      const robots = robotDialogOf(dashboard);
      await robots.opener.click();
      const choosing = page.waitForEvent('filechooser');
      await robots.button('Import a robot file').click();
      await (await choosing).setFiles({ name: 'robot.json', buffer: await kept(version, 'robot.json') });
      await expect(robots.dialog).toContainText('Desk arm is imported.');
      await robots.button('Close').click();

      const library = libraryOf(page);
      await library.show();
      const asking = page.waitForEvent('filechooser');
      await library.button('Import').click();
      await (await asking).setFiles({ name: 'library.json', buffer: await kept(version, 'library.json') });
      await expect(library.card('鞠躬 🤖')).toContainText('1 frame');
      expect(ofKind(await robot.bus(), 'move')).toEqual([]);
    });
  });

const HARMLESS: ReadonlySet<string> = new Set([
  ...['stop', 'readBattery', 'readVersion', 'readPositions', 'readAllPositions'],
]);

/** Every document and file of the browser has its bytes: none of them was edited. */
async function expectNothingLost({ indexedDB: databases }: Profile): Promise<void> {
  const recordsOf = (database: string, store: string): Store['records'] =>
    databases.find(({ name }) => name === database)?.stores.find(({ name }) => name === store)?.records ?? [];
  const store = createBrowserStore('servodeck', Date.now);
  const listed = (await store.list()).documents.map(({ id }) => id);
  for (const { key, value } of recordsOf('servodeck', 'texts')) {
    expect(listed).toContain(key);
    expect((await store.read(key ?? '')).text).toBe(value);
  }
  for (const { value } of recordsOf('servodeck', 'versions')) {
    const { document, id, text } = value as { document: string; id: string; text: string };
    expect(await store.readVersion(document, id)).toBe(text);
  }
  for (const { key, valueEncoded } of recordsOf('servodeck-files', 'files'))
    expect(await storedFile(key ?? '')).toEqual(bytesOf(valueEncoded?.ta.b ?? ''));
}
