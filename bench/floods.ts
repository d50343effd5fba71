// Floods of what one peer or many may send, one kind after another, each at a gateway of its own: how far its memory grows, what
// is left of that 10 s later, and how long a STOP takes meanwhile from the press to the board's pins. The flood runs on the same machine.

import { existsSync } from 'node:fs';
import { createServer } from 'node:net';
import type { AddressInfo, Socket } from 'node:net';
import { family } from '#shared/codec/families.ts';
import { python } from '../scripts/python.mjs';
import { mustRun } from '../scripts/steps.mjs';
import { amount } from './amounts.ts';
import { packetsInto } from './busPackets.ts';
import type { Figure } from './figure.ts';
import { stopFigures, stopTimes } from './presses.ts';
import { temporaryFolder, withBoard, withGateway } from './station.ts';

const PRESSES = amount(40, 3);
const AFTER_S = amount(10, 1);
const GROWTH_LIMIT_MIB = 20;
/** Pages of code and tables that the first of a kind loads stay. */
const LEFT_LIMIT_MIB = 10;
const STOP_LIMIT_MS = 50;
/** The log of the bus is written a moment after. */
const SETTLES_MS = 500;

const KINDS: Readonly<Record<string, string>> = {
  bodies: '200 strangers with bodies of 3 MiB',
  strangers: '1,000 strangers with half a body each',
  heads: '100 strangers whose head does not end',
  slow: '300 strangers who send half a head and wait',
  page: '100 strangers who load the page again and again',
  pings: '5 paired clients that send pings and never read',
  fragments: '5 paired clients that send empty fragments',
  unread: '8 event streams that are never read',
  camera: '20 viewers of a camera that never ends its head',
};

interface Outcome {
  readonly pressedMs: readonly number[];
  readonly grownMiB: number;
  readonly leftMiB: number;
}

export async function measureFloods(): Promise<Figure[]> {
  if (!existsSync('/proc/self/status')) return []; // only Linux keeps such files
  const figures: Figure[] = [];
  // One after the other: two floods at once would measure each other.
  for (const [kind, what] of Object.entries(KINDS))
    figures.push(...(await withEndlessCamera((url) => measureFlood(kind, what, url))));
  return figures;
}

function measureFlood(kind: string, what: string, camera: string): Promise<Figure[]> {
  return withBoard([], async (board) => {
    const data = temporaryFolder();
    const token = await mustRun('pair a script', python, ['bench/paired.py', data]);
    const options = ['--lan', '--camera', `Endless=${camera}`];
    const outcome = await withGateway(
      board.device,
      async (url, pid) => {
        const { hostname, port } = new URL(url);
        const args = [hostname, port, pid, token, kind, PRESSES, AFTER_S].map(String);
        return JSON.parse(
          await mustRun('flood the gateway', python, ['bench/floods.py', ...args]),
        ) as Outcome;
      },
      { data, options, token },
    );
    await new Promise((resolve) => setTimeout(resolve, SETTLES_MS));
    const packets = packetsInto(board.readBusLog());
    const times = stopTimes(outcome.pressedMs, packets, {
      gapMs: family('doc').serviceGapMs,
      stopsPerPress: 3,
    });
    return [
      growth(
        `floods.${kind}.rssGrowthMiB`,
        outcome.grownMiB,
        GROWTH_LIMIT_MIB,
        `at most, of the gateway; ${what}`,
      ),
      growth(`floods.${kind}.rssLeftMiB`, outcome.leftMiB, LEFT_LIMIT_MIB, `${AFTER_S} s after the flood`),
      ...stopFigures(`floods.${kind}.stop`, times, 'a STOP over HTTP meanwhile', STOP_LIMIT_MS),
    ];
  });
}

function growth(key: string, value: number, limit: number, note: string): Figure {
  return {
    key,
    value,
    unit: 'MiB',
    against: { what: 'wanted', value: limit },
    limit: { atMost: limit },
    note,
  };
}

/** Lends a camera that says for ever that its answer will come. */
async function withEndlessCamera<Result>(work: (url: string) => Promise<Result>): Promise<Result> {
  const viewers = new Set<Socket>();
  const server = createServer((viewer) => {
    const repeat = (): void => {
      if (!viewer.destroyed) viewer.write('HTTP/1.1 100 Continue\r\n\r\n', () => setTimeout(repeat, 1));
    };
    viewers.add(viewer);
    viewer.on('error', () => viewer.destroy()).on('close', () => viewers.delete(viewer));
    viewer.once('data', repeat);
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  try {
    return await work(`http://127.0.0.1:${(server.address() as AddressInfo).port}/`);
  } finally {
    server.close();
    viewers.forEach((viewer) => viewer.destroy());
  }
}
