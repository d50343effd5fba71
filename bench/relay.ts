// A question and its answer through everything between a page and a port: Chromium, WebSocket, gateway, pty, the board's
// process, and back; beside pyserial alone on the same port, and beside an echo by the gateway's kind of server without
// any port. Nothing is subtracted.
//
// The board's line takes no time here, so what is left is the relay's own. The question is to run an empty slot: its
// answer is immediate and has no parameters, so no decoder holds it back to see what follows it.

import type { Page } from '@playwright/test';
import { encodeCommand, encodeReport } from '#shared/codec/encode.ts';
import { family } from '#shared/codec/families.ts';
import { PROTOCOL } from '#shared/client/messages.generated.ts';
import { python } from '../scripts/python.mjs';
import { mustRun } from '../scripts/steps.mjs';
import { amount } from './amounts.ts';
import { withEcho } from './echo.ts';
import type { Figure } from './figure.ts';
import { withPage, withSilentBoard } from './station.ts';
import { percentile } from './statistics.ts';

const TRIPS = amount(60, 12);
/** Thrown away: caches and compilers warm up, on both sides alike. */
const WARM_UP_TRIPS = amount(15, 3);
/** No question waits for its turn: longer than the gateway leaves between two packets, and it takes 30 messages a second. */
const PAUSE_MS = 45;

const question = hex(encodeCommand({ kind: 'run', slot: 200, times: 1 }, family('doc')));
const answer = hex(encodeReport({ kind: 'runAccepted' }));

export async function measureRelay(): Promise<Figure[]> {
  const { relayed, echoed, plain } = await withSilentBoard(['--baud', '0'], async (device) => {
    const throughPage = await withPage(device, async (page, url) => ({
      relayed: await tripsThroughPage(page, url),
      echoed: await tripsOfEcho(page),
    }));
    return { ...throughPage, plain: await tripsOfPyserial(device) };
  });
  const figures = (key: string, what: string, rival: readonly number[]): Figure[] =>
    [50, 99].map((percent) => ({
      ...{ key: `relay.${key}P${percent}Us`, value: slowest(relayed, percent), unit: 'µs' },
      against: { what, value: slowest(rival, percent) },
      note: `page, gateway, pty, board and back; ${TRIPS} trips`,
    }));
  return [
    ...figures('roundtrip', 'pyserial alone', plain),
    ...figures('besideEcho', 'bare echo, no port', echoed),
  ];
}

export function slowest(trips: readonly number[], percent: number): number {
  return percentile(trips.slice(WARM_UP_TRIPS), percent);
}

/** The same page and pauses against a server that only sends back. */
function tripsOfEcho(page: Page): Promise<readonly number[]> {
  return withEcho(async (address) => {
    await page.goto(`http://${address}/`);
    return page.evaluate(echoInPage, { trips: WARM_UP_TRIPS + TRIPS, pauseMs: PAUSE_MS });
  });
}

/** Runs in the page, so it may name nothing from outside itself. */
async function echoInPage({
  trips,
  pauseMs,
}: {
  trips: number;
  pauseMs: number;
}): Promise<readonly number[]> {
  const socket = new WebSocket(`ws://${location.host}/`);
  await new Promise((resolve) => (socket.onopen = resolve));
  const microseconds: number[] = [];
  for (let trip = 0; trip < trips; trip += 1) {
    await new Promise((resolve) => setTimeout(resolve, pauseMs));
    const answered = new Promise<number>((resolve) => {
      socket.onmessage = () => resolve(performance.now());
    });
    const askedMs = performance.now();
    socket.send(JSON.stringify({ trip }));
    microseconds.push(((await answered) - askedMs) * 1_000);
  }
  socket.close();
  return microseconds;
}

/** Any document of the gateway's own address will do. Isolated, a page's clock steps by 5 µs instead of 100. */
export async function tripsThroughPage(page: Page, url: string, counted = TRIPS): Promise<readonly number[]> {
  await page.route('**/api/health', async (route) => {
    const response = await route.fetch();
    const headers = { ...response.headers(), 'cross-origin-embedder-policy': 'require-corp' };
    await route.fulfill({ response, headers });
  });
  await page.goto(`${url}/api/health`);
  const trips = WARM_UP_TRIPS + counted;
  return page.evaluate(askInPage, { protocol: PROTOCOL, question, answer, trips, pauseMs: PAUSE_MS });
}

interface Questions {
  readonly protocol: number;
  readonly question: string;
  readonly answer: string;
  readonly trips: number;
  readonly pauseMs: number;
}

/** Drives as a page does: asks for the lease, answers each tick. Names nothing from outside itself, too. */
async function askInPage({
  protocol,
  question,
  answer,
  trips,
  pauseMs,
}: Questions): Promise<readonly number[]> {
  const socket = new WebSocket(`ws://${location.host}/ws?protocol=${protocol}`);
  const say = (message: object): void => socket.send(JSON.stringify(message));
  let nonce: unknown = null;

  /** Resolves with the time of the message whose `field` says `value`, of the link `status` where one is given. */
  const heard = (field: 'type' | 'bytes', value: string, status?: string): Promise<number> =>
    new Promise((resolve, reject) => {
      const late = setTimeout(() => reject(new Error(`no message with ${field} ${value}`)), 5_000);
      socket.onmessage = ({ data }) => {
        const atMs = performance.now();
        const message = JSON.parse(String(data)) as Record<string, unknown>;
        if (message.type === 'refused') reject(new Error(String(data)));
        if (message.type === 'tick') say({ type: 'heartbeat', nonce: (nonce = message.nonce) });
        const link = message.link as { readonly status: string } | undefined;
        if (message[field] !== value || (status !== undefined && link?.status !== status)) return;
        clearTimeout(late);
        resolve(atMs);
      };
    });

  await heard('type', 'welcome');
  const known = heard('type', 'state', 'ready');
  say({ type: 'board', id: 0, board: 'doc' });
  await known;
  const ticked = heard('type', 'tick');
  say({ type: 'lease', action: 'request' });
  await ticked;
  const microseconds: number[] = [];
  for (let id = 1; id <= trips; id += 1) {
    await new Promise((resolve) => setTimeout(resolve, pauseMs));
    const answered = heard('bytes', answer);
    const askedMs = performance.now();
    say({ type: 'packet', id, bytes: question, nonce });
    microseconds.push(((await answered) - askedMs) * 1_000);
  }
  socket.close();
  return microseconds;
}

async function tripsOfPyserial(device: string): Promise<readonly number[]> {
  const args = [device, question, answer, String(WARM_UP_TRIPS + TRIPS), String(PAUSE_MS)];
  const printed = await mustRun('time pyserial alone', python, ['bench/plain_serial.py', ...args]);
  return JSON.parse(printed) as readonly number[];
}

function hex(bytes: Uint8Array): string {
  return Buffer.from(bytes).toString('hex');
}
