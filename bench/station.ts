// What a person has on the table: a simulated board on a serial port, the gateway on it, a browser. Starts the real
// programs, lends them, ends them however the work ended; measures nothing.

import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { chromium, type Browser, type Page } from '@playwright/test';
import type { BusLogEntry } from '#shared/simulator/line.ts';
import { browserForTests, findBrowser } from '../scripts/browser.mjs';
import { bluetoothAddress, bluetoothBoard, simulatedBoard } from '../scripts/cable.mjs';
import { endChild, startChild } from '../scripts/children.mjs';
import { createHidTree } from '../scripts/hid_tree.mjs';
import { python } from '../scripts/python.mjs';
import { at, SetupProblem } from '../scripts/steps.mjs';

const READY_MS = 10_000;
const POLL_MS = 20;
const folders: string[] = [];
let boards = 0;
let browser: Promise<Browser> | undefined;

export interface BoardOnPort {
  readonly device: string;
  /** Every byte of the bus so far, with its time since the epoch. */
  readBusLog(): readonly BusLogEntry[];
}

/** Lends a fresh board to `work`. `simulatorArgs` as for the simulator program, e.g. `--baud 0`. */
export function withBoard<Result>(
  simulatorArgs: readonly string[],
  work: (board: BoardOnPort) => Promise<Result>,
): Promise<Result> {
  const busLog = path.join(temporaryFolder(), 'bus.jsonl');
  return withSilentBoard(['--bus-log', busLog, ...simulatorArgs], (device) =>
    work({ device, readBusLog: () => parseBusLog(readFileSync(busLog, 'utf8')) }),
  );
}

/** One without a log, which takes a tenth of a millisecond of each answer. */
export async function withSilentBoard<Result>(
  simulatorArgs: readonly string[],
  work: (device: string) => Promise<Result>,
  { hid = false } = {},
): Promise<Result> {
  const lines: string[] = [];
  const cable = await simulatedBoard({
    hid,
    link: `build/bench-board-${process.pid}-${(boards += 1)}`,
    simulatorArgs,
    onLine: (line) => lines.push(line),
    onLost: () => lines.push('it ended'),
  });
  try {
    await cable.plug();
    if (!cable.isPlugged()) throw new SetupProblem(`The simulated board did not start: ${lines.join(' ')}`);
    return await work(cable.device);
  } finally {
    await cable.pull();
  }
}

/** As `withBoard`, behind a Bluetooth module; its device is one for a gateway that starts meanwhile. */
export async function withBluetoothBoard<Result>(
  simulatorArgs: readonly string[],
  work: (board: BoardOnPort) => Promise<Result>,
): Promise<Result> {
  const folder = temporaryFolder();
  const busLog = path.join(folder, 'bus.jsonl');
  const board = await bluetoothBoard({ folder, simulatorArgs: ['--bus-log', busLog, ...simulatorArgs] });
  try {
    const device = `ble:${bluetoothAddress}`;
    return await withEnvironment(device, [`DBUS_SYSTEM_BUS_ADDRESS=${board.busAddress}`], () =>
      work({ device, readBusLog: () => parseBusLog(readFileSync(busLog, 'utf8')) }),
    );
  } finally {
    await board.end();
  }
}

/** As `withBoard`, on its own USB cable; its device is one for a gateway that starts meanwhile. */
export async function withHidBoard<Result>(
  simulatorArgs: readonly string[],
  work: (board: BoardOnPort) => Promise<Result>,
): Promise<Result> {
  const folder = temporaryFolder();
  const busLog = path.join(folder, 'bus.jsonl');
  return withSilentBoard(
    ['--bus-log', busLog, ...simulatorArgs],
    (link) => {
      const { tree } = createHidTree(path.join(folder, 'mock'), at(link));
      const environment = ['LD_PRELOAD=libumockdev-preload.so.0', `UMOCKDEV_DIR=${tree}`];
      return withEnvironment('hid', environment, () =>
        work({ device: 'hid', readBusLog: () => parseBusLog(readFileSync(busLog, 'utf8')) }),
      );
    },
    { hid: true },
  );
}

/** What a gateway on that device is started with, as for `env`; others are not to see it. */
const environments = new Map<string, readonly string[]>();

async function withEnvironment<Result>(
  device: string,
  environment: readonly string[],
  work: () => Promise<Result>,
): Promise<Result> {
  environments.set(device, environment);
  try {
    return await work();
  } finally {
    environments.delete(device);
  }
}

/** Goes with this process, however that ends. */
export function temporaryFolder(): string {
  if (folders.length === 0)
    process.once('exit', () => folders.forEach((folder) => rmSync(folder, { recursive: true, force: true })));
  const folder = mkdtempSync(path.join(tmpdir(), 'servodeck-bench-'));
  folders.push(folder);
  return folder;
}

interface GatewayOptions {
  readonly data?: string;
  readonly options?: readonly string[];
  /** Of a script that is paired in `data`, where the options ask for pairing. */
  readonly token?: string;
}

/** Lends `work` the address and the process of a gateway whose port is open. */
export async function withGateway<Result>(
  device: string,
  work: (url: string, pid: number) => Promise<Result>,
  { data = temporaryFolder(), options = [], token }: GatewayOptions = {},
): Promise<Result> {
  const lines: string[] = [];
  const listen = ['--listen', '127.0.0.1:0', '--data', data];
  const serve = ['-m', 'servodeck', 'serve', ...listen, '--serial', device, ...options];
  const command = [...(environments.get(device) ?? []), python, ...serve, '--no-open', '--exit-with-stdin'];
  const [program = '', ...args] = environments.has(device) ? ['env', ...command] : command;
  const gateway = startChild(program, args, (line) => lines.push(line));
  try {
    return await work(await openedGateway(lines, token), gateway.pid ?? 0);
  } finally {
    await endChild(gateway);
  }
}

/** Lends `work` an empty page too, with memory, cache and renderer of its own; the browser serves all groups. */
export async function withPage<Result>(
  device: string,
  work: (page: Page, url: string) => Promise<Result>,
): Promise<Result> {
  browser ??= startBrowser();
  // Pages of this computer may always speak to it; one whose headers a measurement changed has to be allowed.
  const page = await (await browser).newPage({ permissions: ['local-network-access'] });
  // The sliders and the timeline side by side.
  await page.addInitScript(() => sessionStorage.setItem('servodeck.tab', 'actions'));
  try {
    return await withGateway(device, (url) => work(page, url));
  } finally {
    await page.context().close();
  }
}

/** Opens the dashboard and says which board it is, which a new visitor is asked; then motion is allowed. */
export async function openDashboard(page: Page, url: string): Promise<void> {
  await page.goto(url);
  await page.getByRole('button', { name: /^LSC-compatible board / }).click();
  await page.getByRole('slider').first().waitFor();
}

/** Lends `work` the dashboard of a gateway at a board that `lend` lends, e.g. `withBoard`. */
export function withDashboard<Result>(
  lend: typeof withBoard,
  work: (page: Page, board: BoardOnPort) => Promise<Result>,
): Promise<Result> {
  return lend([], (board) =>
    withPage(board.device, async (page, url) => {
      await openDashboard(page, url);
      return work(page, board);
    }),
  );
}

/** Its address, once it has said it, opened its port and asked the board who it is: before that nobody may name the board. */
async function openedGateway(lines: readonly string[], token?: string): Promise<string> {
  const headers = token === undefined ? {} : { Authorization: `Bearer ${token}` };
  const urlIn = (line: string): string | undefined => /http:\/\/[^\s/]+/.exec(line)?.[0];
  const url = await eventually('the gateway to start', () => lines.map(urlIn).find(Boolean));
  return eventually('the gateway to know what the board answers', async () => {
    const response = await fetch(`${url}/api/status`, { headers });
    const { port, link } = (await response.json()) as { port: { status: string }; link: { status: string } };
    return port.status === 'open' && link.status !== 'identifying' ? url : undefined;
  });
}

async function startBrowser(): Promise<Browser> {
  if (findBrowser() === null) await browserForTests();
  const executablePath = findBrowser();
  return chromium.launch(executablePath === null ? {} : { executablePath });
}

async function eventually<Found>(
  what: string,
  look: () => Found | undefined | Promise<Found | undefined>,
): Promise<Found> {
  const untilMs = performance.now() + READY_MS;
  while (performance.now() < untilMs) {
    const found = await look();
    if (found !== undefined) return found;
    await new Promise((resolve) => setTimeout(resolve, POLL_MS));
  }
  throw new SetupProblem(`Waited ${READY_MS / 1_000} s in vain for ${what}.`);
}

/** The log's first line says when its clock began. */
function parseBusLog(text: string): readonly BusLogEntry[] {
  // Behind the last newline stands what the board is writing now.
  const [head = '{}', ...lines] = text.split('\n').slice(0, -1);
  const { startedAtEpochMs } = JSON.parse(head) as { startedAtEpochMs: number };
  return lines.map((line) => {
    const entry = JSON.parse(line) as BusLogEntry;
    return { ...entry, atMs: startedAtEpochMs + entry.atMs };
  });
}
