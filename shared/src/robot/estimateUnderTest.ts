// A simulated board and the estimate of it side by side, for tests: each command as it would leave a session, each answer
// as the session would hear it, and both positions of each servo at many instants.

import { forgotten, UNKNOWN_MOTION, type KnownBoard } from '../motion/model.ts';
import { advance, afterCommand, hears, leewayAt, positionAt, remainingMs } from '../motion/motion.ts';
import { afterCut, afterEnd, afterReport } from '../motion/reports.ts';
import type { Command, Frame } from '../codec/commands.ts';
import { encodeCommand } from '../codec/encode.ts';
import { FAMILIES, type Family } from '../codec/families.ts';
import { wireMs } from '../codec/packet.ts';
import type { Report } from '../codec/reports.ts';
import { createBoard, type Board } from '../simulator/board.ts';
import type { Fault } from '../simulator/faults.ts';
import { isProfileName, type ProfileName } from '../simulator/profileNames.ts';
import { createVirtualClock, type VirtualClock } from '../testing/virtualClock.ts';
import { createGroupMemory, type GroupMemory } from './estimate.ts';
import { createReceiver } from './channelLink.ts';

export interface Sample {
  readonly atMs: number;
  /** How much the board had said by then. */
  readonly reportsHeard: number;
  readonly servo: number;
  readonly estimated: number | null;
  readonly leeway: number;
  readonly simulated: number;
}

export interface EstimateUnderTest {
  readonly clock: VirtualClock;
  readonly board: Board;
  readonly memory: GroupMemory;
  readonly reports: readonly Report[];
  /** Sends it whole, then waits as long as the board needs between two packets. */
  readonly send: (command: Command) => Promise<void>;
  /** As a session does: frame by frame, each with its answer. */
  readonly download: (slot: number, frames: readonly Frame[]) => Promise<void>;
  readonly wait: (ms: number) => Promise<void>;
  /** Waits until no servo has moved for a while and the estimate expects none to. */
  readonly rest: () => Promise<void>;
  readonly forget: () => void;
  readonly samples: readonly Sample[];
}

export interface EstimateOptions {
  readonly family: Family;
  readonly profile: ProfileName;
  /** When the board was switched on: the times of its ticks are unknown. */
  readonly onForMs: number;
  /** A hand-held pad's receiver delays its ticks (S52). */
  readonly hasPad?: boolean;
  readonly faults?: readonly Fault[];
}

/** Every family there is a simulated board of. */
export const SIMULATED = Object.values(FAMILIES).flatMap((family) =>
  isProfileName(family.id) ? [{ family, profile: family.id }] : [],
);

/** The estimate's own rounding, and the board's. */
export const ROUNDING = 1.5;
/** For the tenth of a millisecond in which the simulated board fetches a frame. */
export const FETCH = 1.01;

export function isWrong({ estimated, leeway, simulated }: Sample): boolean {
  return estimated !== null && Math.abs(estimated - simulated) > leeway * FETCH + ROUNDING;
}

/** What the simulated servo travelled in one tick at most: samples are closer than ticks. */
export function longestStep(samples: readonly Sample[]): number {
  const positions = samples.map(({ simulated }) => simulated);
  return Math.max(
    0,
    ...positions.slice(1).map((position, index) => Math.abs(position - (positions[index] ?? 0))),
  );
}

/** No divisor of a tick, so that samples fall everywhere between two. */
const SAMPLE_MS = 7.3;
const ANSWER_MS = 3_000;
/** A group of frames of a second, twice, at the slowest board. */
const LONGEST_WAIT_MS = 15_000;
const QUIET_MS = 100;

export function createEstimateUnderTest({ family, profile, ...options }: EstimateOptions): EstimateUnderTest {
  const clock = createVirtualClock();
  const memory = createGroupMemory();
  const known: KnownBoard = { family, playedFrames: memory.playedFrames };
  const reports: Report[] = [];
  const samples: Sample[] = [];
  let motion = UNKNOWN_MOTION;

  const receiver = createReceiver({ clock, family: () => family, report: hear, noise: () => undefined });
  const board = createBoard({
    ...options,
    ...{ clock, profile, send: (bytes) => receiver.push(bytes, false) },
  });
  const servos = board.snapshot().pulses.map((_, index) => index + 1);

  function hear(report: Report): void {
    reports.push(report);
    motion = afterReport(motion, report, clock.now(), known);
    if (report.kind === 'runFinished') motion = afterEnd(motion, report.slot, clock.now(), known);
    if (report.kind === 'runStopped') motion = afterCut(motion, clock.now(), known);
  }

  function sample(): void {
    const atMs = clock.now();
    motion = advance(motion, atMs, known);
    for (const servo of servos) {
      const estimated = positionAt(motion, servo, atMs);
      const leeway = leewayAt(motion, servo, atMs, family);
      samples.push({
        atMs,
        reportsHeard: reports.length,
        servo,
        estimated,
        leeway,
        simulated: board.pulse(servo),
      });
    }
  }

  async function wait(ms: number): Promise<void> {
    const untilMs = clock.now() + ms;
    while (clock.now() < untilMs) {
      sample();
      await clock.advance(Math.min(SAMPLE_MS, untilMs - clock.now()));
    }
  }

  async function rest(): Promise<void> {
    const isMoving = (): boolean => motion.run !== null || remainingMs(motion, clock.now()) > 0;
    for (const untilMs = clock.now() + LONGEST_WAIT_MS; clock.now() < untilMs && isMoving();)
      await wait(SAMPLE_MS);
    await wait(QUIET_MS);
  }

  async function send(command: Command): Promise<void> {
    const packet = encodeCommand(command, family);
    board.receive(packet);
    await wait(wireMs(packet.length));
    motion = advance(motion, clock.now(), known);
    const isHeard = hears(motion, clock.now());
    motion = afterCommand(motion, command, clock.now(), known);
    if (command.kind === 'setSpeed') memory.setSpeed(command.slot, isHeard ? command.percent : null);
    await wait(family.serviceGapMs);
  }

  async function download(slot: number, frames: readonly Frame[]): Promise<void> {
    motion = advance(motion, clock.now(), known);
    memory.clear(slot);
    for (const [frameIndex, frame] of frames.entries()) {
      const heard = reports.length;
      await send({ kind: 'download', slot, frameCount: frames.length, frameIndex, frame });
      const untilMs = clock.now() + ANSWER_MS;
      while (reports.slice(heard).every(({ kind }) => kind !== 'frameStored') && clock.now() < untilMs)
        await wait(SAMPLE_MS);
    }
    memory.store(slot, frames);
  }

  function forget(): void {
    memory.clear();
    memory.forgetSpeeds();
    motion = forgotten(motion, clock.now());
  }

  return { clock, board, memory, reports, send, download, wait, rest, forget, samples };
}
