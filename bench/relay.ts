// A question and its answer through everything between a page and a port: Chromium, WebSocket, gateway, pty, the board's
// process, and back; beside pyserial alone on the same port. Nothing is subtracted.
//
// The board's line takes no time here, so what is left is the relay's own. The question is to run an empty slot: its
// answer is immediate and has no parameters, so no decoder holds it back to see what follows it.

import type { Page } from '@playwright/test';
import { encodeCommand, encodeReport } from '#shared/protocol/encode.ts';
import { family } from '#shared/protocol/families.ts';
import { python } from '../scripts/python.mjs';
import { mustRun } from '../scripts/steps.mjs';
import type { Figure } from './figure.ts';
import { withBoard, withPage } from './station.ts';
import { percentile } from './statistics.ts';

const TRIPS = 400;
/** Thrown away: caches and compilers warm up, on both sides alike. */
const WARM_UP_TRIPS = 50;
/** Longer than the gateway leaves between two packets (the wire's time and 10 ms), so that no question waits for its turn. */
const PAUSE_MS = 20;

const question = hex(encodeCommand({ kind: 'run', slot: 200, times: 1 }, family('doc')));
const answer = hex(encodeReport({ kind: 'runAccepted' }));

export async function measureRelay(): Promise<Figure[]> {
  const [throughPage, plain] = await withBoard(['--baud', '0'], async ({ device }) => [
    await withPage(device, tripsThroughPage),
    await tripsOfPyserial(device),
  ]);
  const figure = (key: string, percent: number, note: string): Figure => ({
    ...{ key, value: percentile(throughPage.slice(WARM_UP_TRIPS), percent), unit: 'µs', note },
    against: { what: 'pyserial alone', value: percentile(plain.slice(WARM_UP_TRIPS), percent) },
  });
  return [
    figure('relay.roundtripP50Us', 50, `page, gateway, pty, board and back; ${TRIPS} trips`),
    figure('relay.roundtripP99Us', 99, 'the slow ones of the same trips'),
  ];
}

/** Any document of the gateway's own address will do. Isolated, a page's clock steps by 5 µs instead of 100. */
async function tripsThroughPage(page: Page, url: string): Promise<readonly number[]> {
  await page.route('**/api/health', async (route) => {
    const response = await route.fetch();
    const headers = { ...response.headers(), 'cross-origin-embedder-policy': 'require-corp' };
    await route.fulfill({ response, headers });
  });
  await page.goto(`${url}/api/health`);
  const trips = WARM_UP_TRIPS + TRIPS;
  return page.evaluate(askInPage, { question, answer, trips, pauseMs: PAUSE_MS });
}

interface Questions {
  readonly question: string;
  readonly answer: string;
  readonly trips: number;
  readonly pauseMs: number;
}

/** Runs in the page, so it may name nothing from outside itself. */
async function askInPage({ question, answer, trips, pauseMs }: Questions): Promise<readonly number[]> {
  const socket = new WebSocket(`ws://${location.host}/ws`);

  /** Resolves with the time of the message whose `field` says `value`. */
  const heard = (field: 'type' | 'packet', value: string): Promise<number> =>
    new Promise((resolve, reject) => {
      const late = setTimeout(() => reject(new Error(`no message with ${field} ${value}`)), 2_000);
      socket.onmessage = ({ data }) => {
        const atMs = performance.now();
        const message = JSON.parse(String(data)) as Record<string, unknown>;
        if (message.type === 'refused') reject(new Error(String(data)));
        if (message[field] !== value) return;
        clearTimeout(late);
        resolve(atMs);
      };
    });

  await heard('type', 'welcome');
  const microseconds: number[] = [];
  for (let id = 1; id <= trips; id += 1) {
    await new Promise((resolve) => setTimeout(resolve, pauseMs));
    const answered = heard('packet', answer);
    const askedMs = performance.now();
    socket.send(JSON.stringify({ type: 'send', id, packet: question, nonce: null }));
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
