// How old a slider's value is when its last byte leaves the wire, and how much of what the wire takes is used, where the gateway is
// 0 to 50 ms away: the page's own session and gateway channel, a network that delays, the real gateway, a pty and the simulated
// board at 9600 baud. All sliders are dragged at once by a quick pointer, see drag.ts.
//
// Beside the age stands what nothing can pass: half of an echo by the gateway's kind of server over the same network, and the
// packet's time on the wire. Beside the share stands pyserial alone at the board, with no network, which sends the newest value as
// soon as the wire is free.

import { sleep } from '#shared/clock.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { encodeCommand } from '#shared/codec/encode.ts';
import { family as familyOf } from '#shared/codec/families.ts';
import { wireMs } from '#shared/codec/packet.ts';
import { firstMovesMs } from '#shared/robot/rig.ts';
import type { Robot } from '#shared/robot/robot.ts';
import { createGatewayRobot } from '../frontend/src/robot/gatewayRobot.ts';
import { python } from '../scripts/python.mjs';
import { mustRun } from '../scripts/steps.mjs';
import { amount } from './amounts.ts';
import { packetsInto, type BusPacket } from './busPackets.ts';
import { withEcho } from './echo.ts';
import type { Figure } from './figure.ts';
import { realClock } from './realClock.ts';
import { withDelay } from './slowNetwork.ts';
import { withBoard, withGateway, type BoardOnPort } from './station.ts';
import { median, percentile } from './statistics.ts';

const DELAYS_MS = [0, 5, 20, 50];
const SERVO_COUNTS = [6, 32];
const DRAG_MS = amount(700, 400);
/** The page takes no more than that, see useRawDrag.ts. */
const POINTER_MS = 4;
const SHARE_LIMIT = 0.95;
/** The gateway knows by then where they are, so no move is a first one. */
const REST_MS = 700;
const ECHOES = amount(20, 5);
const RETRY_MS = 100;
const TRIES = 30;
const family = familyOf('doc');
/** Event k says 500 + k: each value names the event it came from. */
const FIRST_POSITION = family.position.min;

interface Drag {
  readonly servoCount: number;
  readonly agesMs: readonly number[];
  /** Of the time, how much the wire or the board's gap was busy. */
  readonly share: number;
}

export async function measureNetwork(): Promise<Figure[]> {
  return withBoard([], async (board) => {
    const alone = await dragsOfPyserial(board);
    return withGateway(board.device, async (url) => {
      const gateway = new URL(url).host;
      const figures: Figure[] = [];
      for (const delayMs of DELAYS_MS) {
        const echoMs = await withEcho((echo) => withDelay(echo, delayMs, halfAnEcho));
        const restMs = figures.length === 0 ? firstMovesMs(Math.max(...SERVO_COUNTS)) : REST_MS;
        const drags = await withDelay(gateway, delayMs, (address) => dragsOver(address, board, restMs));
        for (const [index, drag] of drags.entries())
          figures.push(...figuresOf(delayMs, drag, echoMs, alone[index]));
      }
      return figures;
    });
  });
}

function figuresOf(
  delayMs: number,
  { servoCount, agesMs, share }: Drag,
  echoMs: number,
  alone: Drag | undefined,
): Figure[] {
  const key = `network.${delayMs}ms.${servoCount}`;
  const leastMs = echoMs + wireMs(packetOf(servoCount, FIRST_POSITION).length);
  const age = (percent: number): Figure => ({
    ...{ key: `${key}.ageP${percent}Ms`, value: percentile(agesMs, percent), unit: 'ms' },
    against: { what: 'half an echo and wire', value: leastMs },
    note: `${servoCount} sliders, gateway ${delayMs} ms away, ${agesMs.length} packets`,
  });
  return [
    age(50),
    age(99),
    {
      ...{ key: `${key}.share`, value: share, unit: '', note: "of the wire's rate" },
      against: { what: 'pyserial at the board', value: alone?.share ?? NaN },
      limit: { atLeast: SHARE_LIMIT },
    },
  ];
}

/** All are brought to the centre first, for `restMs`. */
async function dragsOver(address: string, board: BoardOnPort, restMs: number): Promise<readonly Drag[]> {
  const session = createGatewayRobot({ url: `ws://${address}/ws`, clock: realClock });
  try {
    await session.open();
    await session.choose(family);
    const most = Math.max(...SERVO_COUNTS);
    session.move(targetsOf(most, family.centre), 0);
    await sleep(realClock, restMs);
    const drags: Drag[] = [];
    for (const servoCount of SERVO_COUNTS) drags.push(await drag(session, servoCount, board));
    // A driver who leaves a robot that moves has it stopped, and the next one would find that.
    await sleep(realClock, REST_MS);
    return drags;
  } finally {
    await session.close();
  }
}

async function drag(session: Robot, servoCount: number, board: BoardOnPort): Promise<Drag> {
  const fromMs = performance.timeOrigin + performance.now();
  const eventsMs: number[] = [];
  while (eventsMs.length < DRAG_MS / POINTER_MS) {
    const position = FIRST_POSITION + eventsMs.length;
    eventsMs.push(performance.timeOrigin + performance.now());
    session.move(targetsOf(servoCount, position), 0);
    const dueMs = fromMs + eventsMs.length * POINTER_MS;
    await sleep(realClock, dueMs - performance.timeOrigin - performance.now());
  }
  return dragIn(board, fromMs, servoCount, (event) => eventsMs[event] ?? NaN, eventsMs.length);
}

const movesOf = (board: BoardOnPort, fromMs: number): readonly BusPacket[] =>
  packetsInto(board.readBusLog().filter(({ atMs }) => atMs >= fromMs)).filter(
    ({ command }) => command.kind === 'move',
  );

const eventOf = ({ command }: BusPacket): number =>
  command.kind === 'move' ? (command.targets[0]?.position ?? 0) - FIRST_POSITION : NaN;

/**
 * The final value waits for the packet before it, and the board's log for the disk. Throws where it never left, which would
 * flatter the rest.
 */
async function dragIn(
  board: BoardOnPort,
  fromMs: number,
  servoCount: number,
  eventMs: (event: number) => number,
  eventCount: number,
): Promise<Drag> {
  const isWhole = (): boolean => movesOf(board, fromMs).map(eventOf).at(-1) === eventCount - 1;
  for (let tries = 0; tries < TRIES && !isWhole(); tries += 1) await sleep(realClock, RETRY_MS);
  const moves = movesOf(board, fromMs);
  const last = moves.at(-1);
  if (last === undefined || eventOf(last) !== eventCount - 1)
    throw new Error(
      `the last value of the gesture was never sent: ${last && eventOf(last)} of ${eventCount}`,
    );
  const during = moves.slice(0, -1);
  const busyMs = during.reduce((sum, { byteCount }) => sum + wireMs(byteCount) + family.serviceGapMs, 0);
  const [first] = during;
  const wholeMs = last.firstByteMs - (first?.firstByteMs ?? NaN);
  return {
    servoCount,
    agesMs: during.map((packet) => packet.endMs - eventMs(eventOf(packet))),
    share: busyMs / wholeMs,
  };
}

async function dragsOfPyserial(board: BoardOnPort): Promise<readonly Drag[]> {
  const drags: Drag[] = [];
  for (const servoCount of SERVO_COUNTS) {
    const amounts = [servoCount, POINTER_MS, DRAG_MS, FIRST_POSITION, family.serviceGapMs].map(String);
    const fromMs = Number(
      await mustRun('drag with pyserial alone', python, ['bench/plain_drag.py', board.device, ...amounts]),
    );
    const eventMs = (event: number): number => fromMs + event * POINTER_MS;
    drags.push(await dragIn(board, fromMs, servoCount, eventMs, DRAG_MS / POINTER_MS));
  }
  return drags;
}

/** Milliseconds one way, with all that a server costs. */
async function halfAnEcho(address: string): Promise<number> {
  const socket = new WebSocket(`ws://${address}/`);
  await new Promise((resolve) => (socket.onopen = resolve));
  const tripsMs: number[] = [];
  for (let trip = 0; trip < ECHOES; trip += 1) {
    const askedMs = performance.now();
    const answered = new Promise((resolve) => (socket.onmessage = resolve));
    socket.send(JSON.stringify({ trip }));
    await answered;
    tripsMs.push(performance.now() - askedMs);
  }
  socket.close();
  return median(tripsMs) / 2;
}

function packetOf(servoCount: number, position: number): Uint8Array {
  return encodeCommand({ kind: 'move', durationMs: 0, targets: targetsOf(servoCount, position) }, family);
}

function targetsOf(servoCount: number, position: number): readonly ServoTarget[] {
  return Array.from({ length: servoCount }, (_, index) => ({ servo: index + 1, position }));
}
