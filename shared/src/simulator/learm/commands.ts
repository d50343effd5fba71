// The two LeArms as values, what LeArm does with a command: the numbers of the other boards and its own ones (boards.md 2.3), with its
// delays before each answer (L13), and how it plays its groups (L6-L11). Knows no bytes on the line and no loop.

import { COMMAND_NUMBER, type Frame } from '../../codec/commands.ts';
import type { Reply } from '../dispatch.ts';
import { type GroupStore, readUint16, uint16 } from '../groupStore.ts';
import type { OwnTimeServos } from '../servos.ts';
import type { Work } from '../agenda.ts';

// The two LeArms as values: with PWM servos and with bus servos (boards.md chapter 4).

export interface LearmTraits {
  /** Its servos, as its version report states them (boards.md 2.3). */
  readonly servoType: 1 | 2;
  /** Its first line of text (L1). */
  readonly greeting: string;
  readonly range: { readonly min: number; readonly max: number };
  /** Of servo 1, the gripper, which would break itself beyond (boards.md 2.1). */
  readonly gripper: { readonly min: number; readonly max: number };
  /** Where the servos go at power-up and after a reset (L1). */
  readonly resetPose: readonly number[];
  /** It checks whether PWM servos have arrived; of bus servos it counts the frame's time (L7). */
  readonly endsFrames: 'arrived' | 'counted';
}

export const PWM_LEARM: LearmTraits = {
  servoType: 1,
  greeting: 'pwm servo',
  range: { min: 500, max: 2500 },
  gripper: { min: 500, max: 1500 },
  resetPose: [770, 1500, 644, 511, 1255, 1500],
  endsFrames: 'arrived',
};

export const BUS_LEARM: LearmTraits = {
  servoType: 2,
  greeting: 'serial servo',
  range: { min: 125, max: 875 },
  gripper: { min: 200, max: 700 },
  resetPose: [226, 500, 177, 129, 408, 500],
  endsFrames: 'counted',
};

interface LearmCommandParts {
  readonly traits: LearmTraits;
  readonly servos: OwnTimeServos;
  readonly store: GroupStore;
  readonly runner: LearmRunner;
  readonly sectorMs: number;
  readonly reply: Reply;
}

export const LEARM_SERVOS: readonly number[] = [1, 2, 3, 4, 5, 6];

const VERSION = 1;
const RESET_MS = 1000;
const OFFSET_LIMIT = 125;
/** The loop of the stop command ends one servo too early (L9). */
const STOPPED_SERVOS = LEARM_SERVOS.slice(0, 5);
const MOVE_ENTRIES_AT = 3;
const FRAME_AT = 3;

type Handler = (params: Uint8Array) => Iterable<number>;
const AT_ONCE: Iterable<number> = [];

/** Serves one command: a run in progress dies of every one but run and stop, even an unknown one (L8). */
export function createLearmCommands(
  parts: LearmCommandParts,
): (command: number, params: Uint8Array) => Iterable<number> {
  const { traits, servos, store, runner, sectorMs, reply } = parts;
  const offsets = new Map(LEARM_SERVOS.map((servo) => [servo, 0]));

  function answer(command: number, delayMs: number, params: () => readonly number[]): Handler {
    return function* (): Work {
      yield delayMs;
      yield* reply(command, params());
    };
  }

  function move(params: Uint8Array): Iterable<number> {
    const end = MOVE_ENTRIES_AT + (params[0] ?? 0) * 3;
    for (let at = MOVE_ENTRIES_AT; at < Math.min(end, params.length); at += 3)
      servos.accept(params[at] ?? 0, readUint16(params, at + 1), readUint16(params, 1));
    return AT_ONCE;
  }

  function run(params: Uint8Array): Iterable<number> {
    runner.request(params[0] ?? 0, readUint16(params, 1));
    return AT_ONCE;
  }

  function stop(): Iterable<number> {
    runner.stop();
    STOPPED_SERVOS.forEach(servos.freeze);
    return AT_ONCE;
  }

  function* erase(): Work {
    yield* store.clearCounts();
    yield 10;
    yield* reply(COMMAND_NUMBER.erase, []);
  }

  function* download(params: Uint8Array): Work {
    const [slot = 0, frameCount = 0, frameIndex = 0] = params;
    const frame = new Uint8Array(store.frameBytes);
    frame.set(params.slice(FRAME_AT, FRAME_AT + store.frameBytes));
    yield* store.saveFrame({ slot, frameCount, frameIndex }, () => frame);
    yield 10;
    yield* reply(COMMAND_NUMBER.download, []);
  }

  function setOffset([servo = 0, byte = 0]: Uint8Array): Iterable<number> {
    const offset = (byte << 24) >> 24;
    if (offsets.has(servo) && Math.abs(offset) <= OFFSET_LIMIT) offsets.set(servo, offset);
    return AT_ONCE;
  }

  function resetPose(): Iterable<number> {
    for (const servo of LEARM_SERVOS) servos.accept(servo, traits.resetPose[servo - 1] ?? 0, RESET_MS);
    return AT_ONCE;
  }

  const positions = () => LEARM_SERVOS.flatMap((servo) => [servo, ...uint16(servos.pulse(servo))]);
  const offsetList = () => [...offsets].flatMap(([servo, offset]) => [servo, offset & 0xff]);

  /** Offsets go to flash (L14). */
  function* saveOffsets(): Work {
    yield sectorMs;
    yield 20;
    yield* reply(11, []);
  }

  const handlers = new Map<number, Handler>([
    [1, answer(1, 30, () => [traits.servoType, VERSION])],
    [2, answer(2, 20, offsetList)],
    [COMMAND_NUMBER.move, move],
    [COMMAND_NUMBER.run, run],
    [COMMAND_NUMBER.stop, stop],
    [COMMAND_NUMBER.erase, erase],
    [10, setOffset],
    [11, saveOffsets],
    [12, resetPose],
    [13, answer(13, 10, positions)],
    [COMMAND_NUMBER.download, download],
  ]);

  return (command, params) => {
    if (command !== COMMAND_NUMBER.run && command !== COMMAND_NUMBER.stop) runner.kill();
    return handlers.get(command)?.(params) ?? AT_ONCE;
  };
}

interface LearmRunner {
  readonly request: (slot: number, times: number) => void;
  readonly stop: () => void;
  /** Another command took the place of the run (L8). */
  readonly kill: () => void;
  readonly step: () => void;
  readonly dueMs: () => number;
  readonly runningSlot: () => number | null;
}

interface LearmRunnerParts {
  readonly now: () => number;
  readonly frameCount: (slot: number) => number;
  /** Null where the frame cannot be played. */
  readonly frame: (slot: number, frameIndex: number) => Frame | null;
  readonly issue: (frame: Frame) => void;
  /** Whether that frame has ended, so many polls after it began. */
  readonly isOver: (frame: Frame, polls: number) => boolean;
}

/** About; the real one jitters (L7). */
const POLL_MS = 110;
/** Before the first frame only the servos can keep it waiting. */
const STANDING: Frame = { durationMs: 0, targets: [] };

export function createLearmRunner({ now, frameCount, frame, issue, isOver }: LearmRunnerParts): LearmRunner {
  let slot: number | null = null;
  let frameTotal = 0;
  let frameIndex = 0;
  let loopsLeft = 0;
  let pollMs = Infinity;
  let playing: Frame | null = null;
  let polls = 0;
  /** The next run takes the killed one's frame for its own and continues behind it (L11). */
  let stale = false;

  function request(requestedSlot: number, times: number): void {
    frameTotal = frameCount(requestedSlot);
    slot = frameTotal === 0 ? null : requestedSlot;
    // Eight bits, and 0 means once: so does 256 (L6).
    loopsLeft = times & 0xff || 1;
    frameIndex = stale ? 1 : 0;
    stale = false;
    pollMs = now();
    playing = null;
  }

  function kill(): void {
    stale ||= slot !== null;
    slot = null;
  }

  function advance(runningSlot: number): void {
    if (frameIndex >= frameTotal) {
      frameIndex = 0;
      loopsLeft -= 1;
    }
    if (loopsLeft === 0) {
      slot = null;
      return;
    }
    const next = frame(runningSlot, frameIndex);
    frameIndex += 1;
    // The run hangs until a stop (L10).
    if (next === null) pollMs = Infinity;
    else begin(next);
  }

  function begin(next: Frame): void {
    issue(next);
    playing = next;
    polls = 0;
  }

  function step(): void {
    if (slot === null || now() < pollMs) return;
    pollMs += POLL_MS;
    polls += 1;
    if (playing === null ? isOver(STANDING, polls) : isOver(playing, polls)) advance(slot);
  }

  return {
    request,
    stop: () => void (slot = null),
    kill,
    step,
    dueMs: () => (slot === null ? Infinity : pollMs),
    runningSlot: () => slot,
  };
}
