// What only tests need: a Chromium and, for cables without hardware, umockdev and dbus-daemon; for the fleet, Mosquitto. Says
// where they are, fetches them where that is possible, and otherwise tells the way out. Knows no test.

import { existsSync } from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { SetupProblem, at, run, say } from './steps.mjs';

const names = [
  'chromium',
  'chromium-browser',
  'google-chrome',
  'google-chrome-stable',
  'chrome',
  'microsoft-edge',
];
const fixedPlaces = [
  '/Applications/Google Chrome.app/Contents/MacOS/Google Chrome',
  '/Applications/Chromium.app/Contents/MacOS/Chromium',
  '/Applications/Microsoft Edge.app/Contents/MacOS/Microsoft Edge',
  String.raw`C:\Program Files\Google\Chrome\Application\chrome.exe`,
  String.raw`C:\Program Files (x86)\Microsoft\Edge\Application\msedge.exe`,
];
const preloadFolders = ['/usr/lib/x86_64-linux-gnu', '/usr/lib/aarch64-linux-gnu', '/usr/lib', '/usr/lib64'];

/**
 * Two pop-ups of an address bar that nobody sees cost a fifth of all the time: they are a page each, in every window. This
 * list takes the place of Playwright's own, so what matters of that one is repeated.
 */
const unwantedFeatures = [
  'WebUIOmniboxPopup',
  'WebUIOmniboxAimPopup',
  'HttpsUpgrades',
  'LensOverlay',
  'MediaRouter',
  'OptimizationHints',
  'PaintHolding',
  'SpareRendererForSitePerProcess',
];

/** What a browser of tests is started with. */
export const browserArgs = [`--disable-features=${unwantedFeatures.join(',')}`];

/** The browser that tests drive, or null: `$CHROMIUM_PATH`, Playwright's own, then whatever the system has. */
export function findBrowser() {
  const candidates = [process.env.CHROMIUM_PATH, playwrightsOwn(), ...onPath(names), ...fixedPlaces];
  return candidates.find((candidate) => candidate && existsSync(candidate)) ?? null;
}

/** Why Chromium cannot be given a mock serial port here, or null where it can. */
export function umockdevProblem() {
  if (process.platform !== 'linux') return 'umockdev exists on Linux only';
  const found = preloadFolders.some((folder) => existsSync(`${folder}/libumockdev-preload.so.0`));
  return found ? null : 'umockdev is not installed (on Debian or Ubuntu: apt install umockdev)';
}

/** Why there can be no stand-in for BlueZ here, or null where there can. */
export function bluezProblem() {
  if (process.platform !== 'linux') return 'BlueZ exists on Linux only';
  const found = onPath(['dbus-daemon']).some((program) => existsSync(program));
  return found ? null : 'dbus-daemon is not installed (on Debian or Ubuntu: apt install dbus-daemon)';
}

/** Fetches what is missing. Without umockdev or dbus-daemon some tests are skipped; without a browser nothing is proved. */
export async function browserForTests() {
  const missing = [];
  if (!findBrowser()) missing.push('chromium', 'fonts-liberation');
  if (umockdevProblem() && process.platform === 'linux') missing.push('umockdev');
  if (bluezProblem() && process.platform === 'linux') missing.push('dbus-daemon');
  if (missing.length > 0) await installSystemPackages(missing);
  if (!findBrowser()) await installPlaywrightsBrowser();
  if (findBrowser()) return;
  throw new SetupProblem(
    'The end-to-end tests need a Chromium, and none was found or could be fetched. Do one of these:\n' +
      "  install Chromium or Chrome with your system's package manager (Debian: sudo apt install chromium)\n" +
      '  npx playwright install chromium\n' +
      '  CHROMIUM_PATH=/path/to/chrome npm test',
  );
}

/** Fetches Mosquitto. Without it the tests of the fleet are skipped. Not beside another installation: apt has one lock. */
export async function brokerForTests() {
  if (!onPath(['mosquitto']).some((program) => existsSync(program)))
    await installSystemPackages(['mosquitto']);
}

/** @param {readonly string[]} packages */
async function installSystemPackages(packages) {
  if (process.getuid?.() !== 0 || !existsSync('/usr/bin/apt-get')) return;
  say(`Installing ${packages.join(', ')} for the tests …`);
  const env = { DEBIAN_FRONTEND: 'noninteractive' };
  const install = ['install', '-y', '--no-install-recommends', ...packages];
  if ((await run('apt-get', install, { env })).code === 0) return;
  await run('apt-get', ['update'], { env });
  await run('apt-get', install, { env });
}

async function installPlaywrightsBrowser() {
  say('Fetching Chromium for the browser tests …');
  await run(process.execPath, [at('node_modules/@playwright/test/cli.js'), 'install', 'chromium']);
}

function playwrightsOwn() {
  try {
    /** @type {typeof import('@playwright/test')} */
    const playwright = createRequire(import.meta.url)('@playwright/test');
    return playwright.chromium.executablePath();
  } catch {
    return null; // before the packages are there
  }
}

/** @param {readonly string[]} programs */
function onPath(programs) {
  const folders = (process.env.PATH ?? '').split(path.delimiter);
  return programs.flatMap((program) => folders.map((folder) => path.join(folder, program)));
}
