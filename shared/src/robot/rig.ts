// A robot on a simulated board in virtual time, for tests and measurements: what a person would do, and what the board
// saw on its line.

import type { Clock } from '../clock.ts';
import type { Command } from '../codec/commands.ts';
import { createDecoder } from '../codec/decoder.ts';
import { family as familyOf } from '../codec/families.ts';
import { wireMs } from '../codec/packet.ts';
import { parseCommand } from '../codec/parse.ts';
import { COMMAND_SHAPES } from '../codec/shapes.ts';
import {
  createSimulatedChannel,
  type SimulatedChannel,
  type SimulatedChannelOptions,
} from '../simulator/channel.ts';
import { createVirtualClock, type VirtualClock } from '../testing/virtualClock.ts';
import { createLocalRobot, type LocalRobotOptions } from './localRobot.ts';
import type { Robot } from './robot.ts';
import { FIRST_MOVE_MS, FIRST_MOVE_STAGGER_MS } from './timings.ts';

export interface HeardCommand {
  /** When its last byte had arrived at the board. */
  readonly atMs: number;
  readonly command: Command;
}

export interface Rig {
  readonly clock: VirtualClock;
  readonly session: Robot;
  readonly channel: SimulatedChannel;
  readonly heard: readonly HeardCommand[];
  /** The session's computer sleeps, and no timer of it fires in time; the board continues. */
  asleep(ms: number): Promise<void>;
  /** Heard commands of one kind, oldest first. */
  ofKind<K extends Command['kind']>(kind: K): readonly Extract<Command, { kind: K }>[];
}

/** By then the stops of an opening have left, also those that end what others left on the line. */
export const OPENING_MS = 900;

/** STOP as it leaves at first; behind it the board is told again and again until it confirms or a person resumes. */
export const STOP_KINDS: readonly Command['kind'][] = ['stop', 'move', 'stop', 'stop', 'move'];

/** Until that many servos, commanded all at once to make their first move, have surely arrived. */
export function firstMovesMs(servoCount: number): number {
  return (servoCount - 1) * FIRST_MOVE_STAGGER_MS + FIRST_MOVE_MS + 500;
}

/** Opened and ready; the board has been on for a while and knows its battery. */
export async function createRig(
  options: SimulatedChannelOptions &
    Partial<
      Pick<LocalRobotOptions, 'family' | 'slotMemory' | 'identifies' | 'isWatched' | 'withheld' | 'isNew'>
    > = {},
): Promise<Rig> {
  const { family = familyOf('doc'), ...rest } = options;
  const { slotMemory, identifies, isWatched, withheld, isNew = true, ...board } = rest;
  const clock = createVirtualClock();
  const heard: HeardCommand[] = [];
  const ear = createEar(clock, heard);
  const channel = createSimulatedChannel(clock, {
    onForMs: 60_000,
    ...board,
    onByte: ({ direction, byte }) => direction === 'in' && ear(byte),
  });
  const computer = createSleepingClock(clock);
  const session = createLocalRobot({
    ...{ channel, clock: computer, family, slotMemory, identifies, isWatched, withheld, isNew },
  });
  await session.open();
  return {
    ...{ clock, session, channel, heard, asleep: computer.asleep },
    ofKind: (kind) => heard.flatMap(({ command }) => (command.kind === kind ? [command as never] : [])),
  };
}

/** Timers that come due while it sleeps fire when it wakes, in their order, as a browser's do. */
function createSleepingClock(clock: VirtualClock): Clock & Pick<Rig, 'asleep'> {
  let isAsleep = false;
  let missed: (() => void)[] = [];
  return {
    now: clock.now,
    after(delayMs, run) {
      const wake = (): void => run();
      const cancelTimer = clock.after(delayMs, () => (isAsleep ? missed.push(wake) : wake()));
      return () => {
        cancelTimer();
        missed = missed.filter((other) => other !== wake);
      };
    },
    async asleep(ms) {
      isAsleep = true;
      await clock.advance(ms);
      isAsleep = false;
      for (let next = missed.shift(); next; next = missed.shift()) next();
      await clock.advance(0);
    },
  };
}

/** Takes the board's bytes one by one. Two byte times of silence end a packet: the gap between two is never that short. */
function createEar(clock: VirtualClock, heard: HeardCommand[]): (byte: number) => void {
  let lastByteMs = 0;
  let cancelIdle = (): void => undefined;
  const decoder = createDecoder((event) => {
    const command = event.kind === 'packet' ? parseCommand(event.packet) : null;
    if (command !== null) heard.push({ atMs: lastByteMs, command });
  }, COMMAND_SHAPES);
  return (byte) => {
    cancelIdle();
    lastByteMs = clock.now();
    decoder.push(Uint8Array.of(byte));
    cancelIdle = clock.after(wireMs(2), () => decoder.idle());
  };
}
