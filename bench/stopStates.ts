// From the press on STOP at a client to the first stop byte at the board's pins, over gateway and pty at 9600 baud, while something
// else goes on: the board plays a group, a download is under way, clients flood the gateway. No page is in these figures; the page
// adds what stop.ts shows.

import { python } from '../scripts/python.mjs';
import { endChild, startChild } from '../scripts/children.mjs';
import { SetupProblem } from '../scripts/steps.mjs';
import { family } from '#shared/codec/families.ts';
import { amount } from './amounts.ts';
import { packetsInto } from './busPackets.ts';
import type { Figure } from './figure.ts';
import { stopFigures, stopTimes, type StopTimes } from './presses.ts';
import { withPresser, type Presser } from './presser.ts';
import { withBoard, withGateway } from './station.ts';

const PRESSES = amount(15, 3);
const STOPS_PER_PRESS = 3;
const SLOT = 8;
/** A download that was stopped has the next one wait 2.5 s; several robots at once take the time of one. */
const ROBOTS = amount(5, 3);
/** Some ten seconds of frames, far more than until it is stopped. */
const FRAMES = Array.from({ length: 200 }, () => ({ durationMs: 500, positions: { 1: 1_500, 2: 1_500 } }));
/** The gateway knows by the clock that the last stop has left; the board may have it a moment later. */
const BOARD_LAG_MS = 500;
const FLOODERS = 10;
const FLOOD_SETTLES_MS = amount(2_000, 1_000);

interface Robot {
  readonly presser: Presser;
  readonly url: string;
}

/** A group that repeats until it is stopped, run anew before each press. */
export async function measureStopRunning(): Promise<Figure[]> {
  const times = await pressed(PRESSES, async ({ presser }) => {
    await presser.send({ kind: 'run', slot: SLOT, times: 0 });
    await presser.waitWithin(60, 300);
  });
  return stopFigures('stop.running', times, 'a group runs on the board');
}

export async function measureStopDownload(): Promise<Figure[]> {
  const each = PRESSES / ROBOTS;
  const robots = Array.from({ length: ROBOTS }, () => pressed(each, downloads));
  return stopFigures('stop.download', joined(await Promise.all(robots)), 'a download is under way');
}

export async function measureStopFlood(): Promise<Figure[]> {
  const times = await pressed(PRESSES, ({ presser }) => presser.waitWithin(20, 120), withFlood);
  return stopFigures('stop.flood', times, `${FLOODERS} clients say 1,000 things a second each`);
}

/** Presses again and again on a robot of its own, each time after `before`, with `beside` around all of it. */
function pressed(
  count: number,
  before: (robot: Robot) => Promise<void>,
  beside: (url: string, work: () => Promise<void>) => Promise<void> = (_, work) => work(),
): Promise<StopTimes> {
  return withBoard([], (board) =>
    withGateway(board.device, (url) =>
      withPresser(url, async (presser) => {
        await presser.drive();
        const fromMs = Date.now();
        const pressedMs: number[] = [];
        await beside(url, async () => {
          for (let press = 0; press < count; press += 1) {
            await before({ presser, url });
            pressedMs.push(await presser.pressAndResume());
          }
        });
        await presser.waitWithin(BOARD_LAG_MS, BOARD_LAG_MS);
        const packets = packetsInto(board.readBusLog().filter(({ atMs }) => atMs >= fromMs));
        const gapMs = family('doc').serviceGapMs;
        return stopTimes(pressedMs, packets, { gapMs, stopsPerPress: STOPS_PER_PRESS });
      }),
    ),
  );
}

/** Until its frames are on their way, and then any moment more. */
async function downloads({ presser, url }: Robot): Promise<void> {
  const body = JSON.stringify({ groups: [{ slot: SLOT, frames: FRAMES }], nonce: presser.nonce });
  const headers = { 'content-type': 'application/json' };
  const answer = await fetch(`${url}/api/download`, { method: 'POST', headers, body });
  const { id, detail } = (await answer.json()) as { id?: string; detail?: string };
  if (id === undefined) throw new Error(`no download: ${detail}`);
  while ((await framesStored(url, id)) === 0) await presser.waitWithin(10, 20);
  await presser.waitWithin(0, 120);
}

async function framesStored(url: string, job: string): Promise<number> {
  const state = (await (await fetch(`${url}/api/jobs/${job}`)).json()) as { framesStored: number };
  return state.framesStored;
}

async function withFlood(url: string, work: () => Promise<void>): Promise<void> {
  const { hostname, port } = new URL(url);
  const lines: string[] = [];
  const flood = startChild(python, ['bench/flood.py', hostname, port, String(FLOODERS)], (line) =>
    lines.push(line),
  );
  try {
    await new Promise((resolve) => setTimeout(resolve, FLOOD_SETTLES_MS));
    await work();
    if (flood.exitCode !== null) throw new SetupProblem(`The flood ended: ${lines.join('\n')}`);
  } finally {
    await endChild(flood);
  }
}

function joined(robots: readonly StopTimes[]): StopTimes {
  return {
    firstByteMs: robots.flatMap(({ firstByteMs }) => firstByteMs),
    overWireMs: robots.flatMap(({ overWireMs }) => overWireMs),
    wireMs: Math.max(...robots.map(({ wireMs }) => wireMs)),
  };
}
