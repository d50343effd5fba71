// How far from its time each frame of a played group begins to leave: beside the gateway, over a network that delays each message by
// another time, and played locally, by the session of a direct link. The times are those of the bus, in real time.

import { sleep } from '#shared/clock.ts';
import type { Frame } from '#shared/codec/commands.ts';
import { family as familyOf } from '#shared/codec/families.ts';
import { createLocalRobot } from '#shared/robot/localRobot.ts';
import type { Robot } from '#shared/robot/robot.ts';
import { createSimulatedChannel } from '#shared/simulator/channel.ts';
import type { BusLogEntry } from '#shared/simulator/line.ts';
import { createGatewayRobot } from '../frontend/src/robot/gatewayRobot.ts';
import { amount } from './amounts.ts';
import { packetsInto } from './busPackets.ts';
import type { Figure } from './figure.ts';
import { realClock } from './realClock.ts';
import { withDelay } from './slowNetwork.ts';
import { withBoard, withGateway } from './station.ts';
import { percentile } from './statistics.ts';

const FRAME_MS = 100;
const FRAME_COUNT = amount(24, 8);
const SERVO_COUNT = 6;
const DELAY_MS = 20;
const LIMIT_MS = 2;
const family = familyOf('doc');
const servos = Array.from({ length: SERVO_COUNT }, (_, index) => index + 1);

export async function measurePlay(): Promise<Figure[]> {
  const local = await playedLocally();
  return withBoard([], (board) =>
    withGateway(board.device, async (url) => {
      const gateway = new URL(url).host;
      const over = (address: string): Promise<readonly number[]> => playedOver(address, board.readBusLog);
      const near = await over(gateway);
      const far = await withDelay(gateway, DELAY_MS, over, DELAY_MS);
      return [
        ...figuresOf('local', local, 'by the session of a direct link'),
        ...figuresOf('near', near, 'by the gateway, beside it', local),
        ...figuresOf('far', far, `by the gateway, ${DELAY_MS} ± ${DELAY_MS} ms away`, local),
      ];
    }),
  );
}

function figuresOf(
  key: string,
  offMs: readonly number[],
  how: string,
  local?: readonly number[],
): readonly Figure[] {
  const note = `${FRAME_COUNT} frames of ${FRAME_MS} ms, ${SERVO_COUNT} servos, played ${how}`;
  return [50, 99, 100].map((percent) => ({
    ...{ key: `play.${key}.offP${percent}Ms`, value: percentile(offMs, percent), unit: 'ms', note },
    ...(local !== undefined && { against: { what: 'local', value: percentile(local, percent) } }),
    ...(local !== undefined && percent === 99 && { limit: { atMost: LIMIT_MS } }),
  }));
}

async function playedLocally(): Promise<readonly number[]> {
  const log: BusLogEntry[] = [];
  const channel = createSimulatedChannel(realClock, {
    servoCount: SERVO_COUNT,
    onByte: (entry) => log.push(entry),
  });
  const session = createLocalRobot({ channel, isNew: true, family, clock: realClock });
  await session.open();
  return played(session, () => log);
}

async function playedOver(
  address: string,
  readLog: () => readonly BusLogEntry[],
): Promise<readonly number[]> {
  const session = createGatewayRobot({ url: `ws://${address}/ws`, clock: realClock });
  try {
    await session.open();
    await session.choose(family);
    return await played(session, readLog);
  } finally {
    await session.close();
  }
}

/** How far each frame behind the way to the first one was from its time, by the bus. */
async function played(session: Robot, readLog: () => readonly BusLogEntry[]): Promise<readonly number[]> {
  const before = readLog().length;
  await session.play(frames());
  await sleep(realClock, 200);
  const moves = packetsInto(readLog().slice(before)).filter(({ command }) => command.kind === 'move');
  const began = moves.slice(-(FRAME_COUNT - 1)).map(({ firstByteMs }) => firstByteMs);
  if (began.length < FRAME_COUNT - 1) throw new Error(`${moves.length} moves left of ${FRAME_COUNT} frames`);
  const errors = began.map((atMs, index) => atMs - index * FRAME_MS);
  const usual = percentile(errors, 50);
  return errors.map((error) => Math.abs(error - usual));
}

function frames(): readonly Frame[] {
  return Array.from({ length: FRAME_COUNT }, (_, index) => ({
    durationMs: FRAME_MS,
    targets: servos.map((servo) => ({ servo, position: 1500 + 10 * (index % 20) })),
  }));
}
