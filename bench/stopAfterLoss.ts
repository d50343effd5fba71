// STOP while the port is lost and comes back: from the press, or from the moment the port could be opened again where that was
// later, to the first stop byte in it. The port is a TCP one, so that the moment is known; nothing slows its bytes.

import { once } from 'node:events';
import { createServer, type AddressInfo, type Socket } from 'node:net';
import { family } from '#shared/codec/families.ts';
import { wireMs } from '#shared/codec/packet.ts';
import { amount } from './amounts.ts';
import type { Figure } from './figure.ts';
import { stopFigures, type StopTimes } from './presses.ts';
import { withPresser, type Presser } from './presser.ts';
import { withGateway } from './station.ts';

const HOST = '127.0.0.1';
/** A port that was open that long is tried again after a quarter of a second; one that was lost sooner, later and later. */
const STEADY_MS = 5_100;
/** From before it is tried again until behind the stop that the gateway sends by itself. */
const PRESS_WITHIN_MS = 400;
const SEQUENCE_MS = 300;
/** Each takes five seconds and next to nothing of the processor. */
const ROBOTS = amount(7, 2);
const PRESSES_EACH = amount(2, 1);
const STOP = Buffer.from([0x55, 0x55, 0x02, 0x07]);

interface Port {
  readonly device: string;
  /** The connection is cut; it may be made again at once. */
  cut(): void;
  /** When it was made last, and when each stop began, in milliseconds since the epoch. */
  readonly openedMs: () => number;
  readonly stopsMs: () => readonly number[];
}

export async function measureStopReconnect(): Promise<Figure[]> {
  const robots = await Promise.all(Array.from({ length: ROBOTS }, () => withPort(pressesAfterCuts)));
  const waits = robots.flat();
  const gapMs = family('doc').serviceGapMs;
  const times: StopTimes = {
    firstByteMs: waits,
    overWireMs: waits.map((waitMs) => Math.max(0, waitMs - gapMs)),
    wireMs: gapMs,
  };
  return stopFigures('stop.reconnect', times, 'the port was lost; from when it can be opened again');
}

function pressesAfterCuts(port: Port): Promise<readonly number[]> {
  return withGateway(port.device, (url) =>
    withPresser(url, async (presser) => {
      const waits: number[] = [];
      for (let press = 0; press < PRESSES_EACH; press += 1) waits.push(await pressAfterCut(port, presser));
      return waits;
    }),
  );
}

async function pressAfterCut(port: Port, presser: Presser): Promise<number> {
  await presser.waitWithin(STEADY_MS, STEADY_MS);
  port.cut();
  await presser.waitWithin(0, PRESS_WITHIN_MS);
  const pressedMs = presser.press();
  await presser.waitWithin(PRESS_WITHIN_MS, PRESS_WITHIN_MS);
  await presser.waitWithin(SEQUENCE_MS, SEQUENCE_MS);
  const fromMs = Math.max(pressedMs, port.openedMs());
  const stopMs = port.stopsMs().find((atMs) => atMs >= fromMs);
  if (stopMs === undefined) throw new Error('a press while the port came back was missed');
  await presser.resume();
  return stopMs - fromMs;
}

/** A row of stops is written at once, and each of them leaves at its time. */
function stopsIn(bytes: Buffer, atMs: number): readonly number[] {
  const times: number[] = [];
  for (let at = bytes.indexOf(STOP); at >= 0; at = bytes.indexOf(STOP, at + STOP.length))
    times.push(atMs + wireMs(at));
  return times;
}

async function withPort<Result>(work: (port: Port) => Promise<Result>): Promise<Result> {
  const sockets: Socket[] = [];
  let openedMs = 0;
  const stopsMs: number[] = [];
  const server = createServer((socket) => {
    sockets.push(socket);
    openedMs = Date.now();
    // Packets are written whole, and nothing else is written here.
    socket.on('data', (bytes) => stopsMs.push(...stopsIn(bytes, Date.now())));
    socket.on('error', () => socket.destroy());
  });
  server.listen(0, HOST);
  await once(server, 'listening');
  try {
    return await work({
      device: `socket://${HOST}:${(server.address() as AddressInfo).port}`,
      cut: () => sockets.at(-1)?.destroy(),
      openedMs: () => openedMs,
      stopsMs: () => stopsMs,
    });
  } finally {
    sockets.forEach((socket) => socket.destroy());
    server.close();
  }
}
