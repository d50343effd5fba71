// A simulated board in virtual time behind a line of JSON on stdio, for tests of the gateway: a time in, what the board said until then
// out, when each pulse changed last, and how far a STOP threw it. Also draws the histories, so that both languages try the same ones. No
// session.

import { createInterface } from 'node:readline';
import fc from 'fast-check';
import type { Clock } from '../clock.ts';
import type { Command } from '../codec/commands.ts';
import { fromHex, toHex } from '../codec/packet.ts';
import { commandIn } from '../codec/parse.ts';
import { createBoard, type Board } from '../simulator/board.ts';
import type { Fault } from '../simulator/faults.ts';
import { isProfileName, type ProfileName } from '../simulator/profileNames.ts';
import {
  SERVOS,
  type Situation,
  somePlainHistory,
  someSituationHistory,
  someStopHistory,
  type StopHistory,
} from './historiesUnderTest.ts';
import { foreignFlash, SLOW_FLASH } from './stopUnderTest.ts';
import { createThrowWatch, situationsOf, type ThrowWatch } from './throwsUnderTest.ts';

/** Anything else is a packet (hexadecimal), or behind `noise` bytes that nobody sent. */
type Happening = readonly [
  atMs: number,
  what: 'unplug' | 'plugIn' | 'restart' | 'press' | 'resume' | (string & {}),
];

const DRAWN = { any: someStopHistory, plain: somePlainHistory, situation: someSituationHistory } as const;

type Request =
  | {
      readonly draw: string;
      readonly seed: number;
      readonly count: number;
      readonly kind: keyof typeof DRAWN;
    }
  | {
      readonly start: string;
      readonly history: StopHistory;
      readonly faults?: readonly Fault[];
      readonly sampled?: Sampling;
    }
  /** Until then, or until it says something. */
  | { readonly untilMs: number; readonly happened: readonly Happening[] };

/** The pulses of these servos are reported as they are at each whole multiple of that time. */
interface Sampling {
  readonly servos: readonly number[];
  readonly everyMs: number;
}

interface SteppedClock extends Clock {
  /** Fires what is due until then; earlier where `isEnough` says so. */
  advanceTo(untilMs: number, isEnough?: () => boolean): void;
}

/** Nothing of a board is a promise, so its time need not wait for any. */
function createSteppedClock(): SteppedClock {
  let timers: readonly { readonly dueMs: number; readonly run: () => void }[] = [];
  let nowMs = 0;
  return {
    now: () => nowMs,
    after(delayMs, run) {
      const timer = { dueMs: nowMs + Math.max(0, delayMs), run };
      timers = [...timers, timer];
      return () => (timers = timers.filter((other) => other !== timer));
    },
    advanceTo(untilMs, isEnough = () => false) {
      while (!isEnough()) {
        const next = timers.find(({ dueMs }) => timers.every((other) => dueMs <= other.dueMs));
        if (next === undefined || next.dueMs > untilMs) {
          nowMs = untilMs;
          return;
        }
        timers = timers.filter((timer) => timer !== next);
        nowMs = next.dueMs;
        next.run();
      }
    },
  };
}

const NOT_SAMPLED: Sampling = { servos: [], everyMs: Infinity };

interface Bench {
  readonly clock: SteppedClock;
  readonly board: Board;
  said: string;
  /** As they were looked at last, and when each changed last. */
  pulses: readonly number[];
  readonly movedMs: number[];
  readonly sampled: Sampling;
  nextSampleMs: number;
  /** Since the last answer, oldest first. */
  samples: readonly (readonly number[])[];
  readonly history: StopHistory;
  readonly throws: ThrowWatch;
  readonly commands: Command[];
  /** What the last STOP met. */
  met: readonly Situation[];
}

function createBench(
  profile: ProfileName,
  history: StopHistory,
  some: readonly Fault[],
  sampled: Sampling,
): Bench {
  const { onForMs, hasPad, isSlow, unknown } = history;
  const flash = foreignFlash(profile, unknown);
  const faults = [...(isSlow ? SLOW_FLASH : []), ...some];
  const clock = createSteppedClock();
  const send = (bytes: Uint8Array): void => void (bench.said += toHex(bytes));
  const board = createBoard({ clock, profile, flash, faults, onForMs, hasPad, send });
  const bench: Bench = {
    clock,
    board,
    said: '',
    pulses: look(board),
    movedMs: SERVOS.map(() => 0),
    sampled,
    nextSampleMs: sampled.everyMs,
    samples: [],
    history,
    throws: createThrowWatch(board, clock),
    commands: [],
    met: [],
  };
  return bench;
}

function look(board: Board): readonly number[] {
  return SERVOS.map(board.pulse);
}

function advance(bench: Bench, untilMs: number): void {
  const { board, sampled } = bench;
  while (bench.said === '' && bench.nextSampleMs <= untilMs) {
    run(bench, bench.nextSampleMs);
    if (bench.clock.now() < bench.nextSampleMs) return;
    bench.samples = [...bench.samples, sampled.servos.map(board.pulse)];
    bench.nextSampleMs += sampled.everyMs;
  }
  run(bench, untilMs);
}

function run(bench: Bench, untilMs: number): void {
  bench.clock.advanceTo(untilMs, () => {
    const pulses = look(bench.board);
    pulses.forEach((pulse, index) => {
      if (pulse !== bench.pulses[index]) bench.movedMs[index] = bench.clock.now();
    });
    bench.pulses = pulses;
    bench.throws.look();
    return bench.said !== '';
  });
}

const NOISE = /^noise (.*)$/;

function happen(bench: Bench, what: Happening[1]): void {
  const { board, throws, commands, history } = bench;
  const noise = NOISE.exec(what)?.[1];
  if (what === 'unplug') board.unplug();
  else if (what === 'plugIn') board.plugIn();
  else if (what === 'restart') board.reboot();
  else if (what === 'resume') throws.resumed();
  else if (what === 'press') {
    throws.pressed();
    bench.met = situationsOf(board, history, commands);
  } else if (noise !== undefined) {
    throws.disturbed();
    board.receive(fromHex(noise));
  } else leave(bench, fromHex(what));
}

function leave({ board, throws, commands }: Bench, packet: Uint8Array): void {
  const command = commandIn(packet);
  if (command !== null) {
    commands.push(command);
    throws.leaves(command);
  }
  board.receive(packet);
}

let bench: Bench | null = null;

function answer(request: Request): unknown {
  if ('draw' in request) {
    const some = DRAWN[request.kind](profileName(request.draw));
    return fc.sample(some, { seed: request.seed, numRuns: request.count });
  }
  if ('start' in request) {
    bench?.board.powerOff();
    const { start, history, faults = [], sampled = NOT_SAMPLED } = request;
    bench = createBench(profileName(start), history, faults, sampled);
    return {};
  }
  if (bench === null) throw new RangeError('no board was started');
  for (const [atMs, what] of request.happened) {
    advance(bench, atMs);
    // The caller was sure that the board is silent until then.
    if (bench.clock.now() < atMs) return { early: bench.said, atMs: bench.clock.now() };
    happen(bench, what);
  }
  advance(bench, request.untilMs);
  const { clock, board, said, movedMs, met, samples } = bench;
  bench.said = '';
  bench.samples = [];
  const isRunning = board.runningSlot() !== null;
  return { atMs: clock.now(), said, isRunning, movedMs, thrownBy: bench.throws.thrownBy(), met, samples };
}

function profileName(text: string): ProfileName {
  if (isProfileName(text)) return text;
  throw new RangeError(`no board is called "${text}"`);
}

createInterface({ input: process.stdin }).on('line', (line) => {
  process.stdout.write(`${JSON.stringify(answer(JSON.parse(line) as Request))}\n`);
});
