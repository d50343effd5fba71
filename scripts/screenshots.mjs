// `npm run screenshots`: takes the pictures of docs/images from the built page on its simulated board; names as arguments take
// those alone, `NAME.zh` one of the Chinese page. What a picture shows is done as a person does it. Run `npm run build` first.

import { mkdtempSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { chromium } from '@playwright/test';
import { preview } from 'vite';
import { findBrowser } from './browser.mjs';
import { endChild, startChild } from './children.mjs';
import { answerForFleet } from './fleet_sample.mjs';
import { python } from './python.mjs';
import { SetupProblem, at, main, say } from './steps.mjs';
import { messagesOf, readTree } from './words.mjs';

/** @typedef {import('@playwright/test').Page} Page */
/** @typedef {{ width: number, height: number, colorScheme?: 'light', workspace?: string, region?: string, dialog?: string, isOwner?: boolean, entry?: string, answers?: (page: Page) => Promise<unknown>, act?: (page: Page) => Promise<unknown> }} Shot */

const DESK = { width: 1440, height: 900 };
/** High enough for a panel as a whole. */
const TALL = { width: 1440, height: 1230, workspace: 'actions' };
/** Where sliders and timeline are side by side. */
const ANIMATE = { width: 1400, height: 860, workspace: 'actions' };
const PHONE = { width: 390, height: 844 };
/** What a gateway calls itself: links in pictures lead nowhere. */
const ROBOT = 'http://robot.example';
/** A picture that is larger makes the repository heavy. */
const LARGEST_BYTES = 220_000;
/** The arm of a first visit has risen, and the battery was read twice. */
const BREATH_MS = 2500;
const SETTLE_MS = 7000;

/** Pictures whose words a Chinese reader looks for. */
const ALSO_IN_CHINESE = ['dashboard', 'phone', 'connect', 'connect-hand', 'connect-board'];
const CHINESE = new Map(messagesOf(readTree('zh')));
/** Of the picture that is being taken. */
let language = 'en';

/** What the page calls it in its language: one English word may be several Chinese ones. @param {string} english */
function named(english) {
  if (language === 'en') return { name: english, exact: true };
  const keys = messagesOf(readTree('en')).flatMap(([key, message]) => (message === english ? [key] : []));
  return { name: new RegExp(`^(${keys.map((key) => CHINESE.get(key)).join('|')})$`) };
}

/** @param {Page} page @param {string | RegExp} name */
const press = (page, name) =>
  page.getByRole('button', typeof name === 'string' ? named(name) : { name }).click();

/** @param {Page} page @param {string} name */
const choose = (page, name) => page.getByRole('radio', named(name)).check();

/** @param {Page} page @param {number} [number] */
async function example(page, number = 0) {
  await press(page, 'Begin with an example');
  await page.getByRole('list', named('Examples for this robot')).getByRole('button').nth(number).click();
}

/** @param {Page} page */
async function wave(page) {
  await example(page);
  await page.getByRole('region', named('Action group')).hover({ position: { x: 20, y: 20 } });
  await page.mouse.wheel(0, -2000);
  await page.mouse.move(0, 0);
}

/** In the middle of it. @param {Page} page */
async function tryPick(page) {
  await choose(page, '3D');
  await press(page, 'Pick and place');
  await page.waitForTimeout(4000);
}

/** Each example as a group of its own. @param {Page} page @param {(number: number) => Promise<unknown>} [then] */
async function groups(page, then) {
  const LAST = 3;
  for (let number = 0; number <= LAST; number += 1) {
    await example(page, number);
    await then?.(number);
    await page.waitForTimeout(1500);
    await press(page, 'Library');
    await press(page, number < LAST ? 'New group' : 'Close');
  }
}

/** @param {Page} page */
async function slots(page) {
  await groups(page, async (number) => {
    const slot = page.getByRole('textbox', { name: 'Slot', exact: true });
    await slot.fill(String(5 + number));
    await slot.press('Enter');
    // At first the robot breathes; it ends that before it takes anything.
    await page.waitForTimeout(BREATH_MS);
    await press(page, 'Download');
    await page.getByText(/ is downloaded\./).waitFor({ timeout: 30_000 });
    await press(page, 'Dismiss');
  });
  await press(page, 'Slots');
}

/** @param {Page} page */
async function poses(page) {
  await choose(page, 'Poses');
  for (const [servo, position] of [
    [3, 1200],
    [4, 1350],
    [5, 1800],
  ]) {
    const target = page.getByRole('textbox', { name: `Servo ${servo} target`, exact: true });
    await target.fill(String(position));
    await target.press('Enter');
    await page.waitForTimeout(1500);
    await press(page, 'Capture pose');
  }
}

/** @param {Page} page */
async function blend(page) {
  await poses(page);
  await page.getByRole('switch', { name: 'Blend', exact: true }).check();
  await page.getByRole('combobox', { name: 'Blend with' }).selectOption({ index: 1 });
}

/** @param {Page} page */
async function calibrate(page) {
  await press(page, /^Robot: /);
  await press(page, 'Calibrate');
}

/** @param {Page} page @param {string} body */
async function connect(page, body) {
  await press(page, 'Connect');
  await choose(page, body);
}

/** @param {Page} page */
async function invite(page) {
  await press(page, 'People and devices');
  await page.getByRole('combobox', { name: 'Role', exact: true }).selectOption('driver');
  await press(page, 'Show a QR code');
}

/** Comes in as its first owner. @param {Page} page @param {string} invitation */
async function comeIn(page, invitation) {
  await page.goto(invitation);
  await page.getByRole('textbox', { name: 'Your name' }).fill('Mei');
  await press(page, 'Continue');
}

/** @param {Page} page @param {number} warnMv */
async function pack(page, warnMv) {
  await press(page, 'Battery settings');
  await choose(page, '2S pack');
  const warn = page.getByRole('textbox', { name: 'Warn at, in millivolts', exact: true });
  await warn.fill(String(warnMv));
  await warn.press('Enter');
}

/** @type {Readonly<Record<string, Shot>>} */
const SHOTS = {
  // First: the invitation of a gateway ends after two minutes.
  people: { ...ANIMATE, workspace: 'live', dialog: 'People and devices', isOwner: true, act: invite },
  dashboard: { ...DESK, act: tryPick },
  animate: { ...ANIMATE, act: wave },
  light: { ...ANIMATE, colorScheme: 'light', act: wave },
  phone: PHONE,
  timeline: { ...TALL, region: 'Action group', act: wave },
  poses: { ...ANIMATE, region: 'Poses', act: blend },
  pad: { ...ANIMATE, region: 'Keys and pad', act: (page) => choose(page, 'Keys and pad') },
  battery: { ...ANIMATE, act: (page) => pack(page, 7000) },
  'low-battery': {
    ...ANIMATE,
    region: 'Battery',
    async act(page) {
      await pack(page, 7600);
      await press(page, 'Close');
      await page.getByText(/^The battery is low/).waitFor({ timeout: 30_000 });
    },
  },
  calibration: { ...ANIMATE, act: calibrate },
  slots: { ...ANIMATE, act: slots },
  library: {
    ...ANIMATE,
    async act(page) {
      await groups(page);
      await press(page, 'Library');
    },
  },
  connect: { ...ANIMATE, workspace: 'live', act: (page) => press(page, 'Connect') },
  'connect-hand': {
    ...ANIMATE,
    workspace: 'live',
    dialog: 'Connect a robot',
    act: (page) => connect(page, 'Hand'),
  },
  'connect-board': {
    ...ANIMATE,
    workspace: 'live',
    dialog: 'Connect a robot',
    act: (page) => connect(page, 'Board or other'),
  },
  fleet: {
    ...ANIMATE,
    height: 790,
    entry: 'fleet.html',
    answers: answerForFleet,
    async act(page) {
      await page.getByRole('checkbox', { name: 'Select arm-1', exact: true }).check();
      await page.getByRole('checkbox', { name: 'Select arm-4', exact: true }).check();
      await page.mouse.move(0, 0);
    },
  },
  stopped: { ...DESK, act: (page) => press(page, /^Stop/) },
  disconnected: {
    ...ANIMATE,
    async act(page) {
      await press(page, 'Connect');
      await press(page, 'Disconnect');
    },
  },
};

/** @param {Page} page @param {Shot} shot */
function partOf(page, { region, dialog }) {
  if (dialog !== undefined) return page.getByRole('dialog', named(dialog));
  return region === undefined ? page : page.getByRole('region', named(region));
}

/** A gateway without a robot, at ROBOT for those who know its port. */
async function startGateway() {
  const data = mkdtempSync(path.join(tmpdir(), 'servodeck-pictures-'));
  const args = [
    '--listen',
    '127.0.0.1:0',
    '--public-url',
    ROBOT,
    '--no-open',
    '--exit-with-stdin',
    '--data',
    data,
  ];
  /** @type {string[]} */
  const said = [];
  /** @type {import('./children.mjs').Child | undefined} */
  let child;
  /** @type {{ port: string, invitation: string }} */
  const ready = await new Promise((resolve, reject) => {
    child = startChild(python, ['-m', 'servodeck', 'serve', ...args], (line) => {
      said.push(line);
      const [, port] = /^Servodeck is at \S+:(\d+)$/m.exec(said.join('\n')) ?? [];
      const [, invitation] = /open (\S+#pair=\S+)/.exec(line) ?? [];
      if (port !== undefined && invitation !== undefined) resolve({ port, invitation });
    });
    child.on('close', () => reject(new SetupProblem(`The gateway ended: ${said.join('\n')}`)));
  });
  return {
    ...ready,
    async end() {
      if (child !== undefined) await endChild(child);
      rmSync(data, { recursive: true, force: true });
    },
  };
}

/**
 * @param {import('@playwright/test').Browser} browser @param {string} url @param {string} invitation @param {string} name
 */
async function take(browser, url, invitation, name) {
  const [shown = '', inLanguage = 'en'] = name.split('.');
  const shot = SHOTS[shown];
  if (shot === undefined)
    throw new SetupProblem(`No picture is called ${name}: ${Object.keys(SHOTS).join(', ')}`);
  const { width, height, colorScheme = 'dark', workspace = 'live', isOwner = false, entry = '', act } = shot;
  language = inLanguage;
  const locale = language === 'en' ? 'en-GB' : 'zh-CN';
  const context = await browser.newContext({ viewport: { width, height }, colorScheme, locale });
  const page = await context.newPage();
  await page.addInitScript((tab) => sessionStorage.setItem('servodeck.tab', tab), workspace);
  await shot.answers?.(page);
  await (isOwner ? comeIn(page, invitation) : page.goto(new URL(entry, url).href));
  await page.waitForTimeout(SETTLE_MS);
  await act?.(page);
  await page.waitForTimeout(1000);
  const file = at(`docs/images/${name}.png`);
  await partOf(page, shot).screenshot({ path: file });
  await context.close();
  const { size } = statSync(file);
  say(`docs/images/${name}.png: ${Math.round(size / 1000)} kB${size > LARGEST_BYTES ? ', too large' : ''}`);
  return size <= LARGEST_BYTES;
}

await main(async () => {
  const executablePath = findBrowser();
  if (executablePath === null) throw new SetupProblem('Pictures are taken by a Chromium, and there is none.');
  // No gateway has a part in it, but for the picture of people.
  const server = await preview({
    configFile: at('vite.config.ts'),
    logLevel: 'warn',
    preview: { port: 0, proxy: {} },
  });
  const gateway = await startGateway();
  const browser = await chromium.launch({
    executablePath,
    args: [
      `--host-resolver-rules=MAP ${new URL(ROBOT).host}:80 127.0.0.1:${gateway.port}`,
      ...(process.getuid?.() === 0 ? ['--no-sandbox'] : []),
    ],
  });
  const url = server.resolvedUrls?.local[0] ?? '';
  const names = process.argv.slice(2);
  const all = [...Object.keys(SHOTS), ...ALSO_IN_CHINESE.map((name) => `${name}.zh`)];
  let areSmall = true;
  for (const name of names.length > 0 ? names : all)
    areSmall = (await take(browser, url, gateway.invitation, name)) && areSmall;
  await browser.close();
  await server.close();
  await gateway.end();
  return areSmall ? 0 : 1;
});
