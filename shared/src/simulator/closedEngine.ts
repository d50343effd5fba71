// LSC, Bus Servo Controller and xArm by their documents (boards.md chapter 5), with the commands that only they have (2.3): their
// firmware is closed, so what is not documented follows the open firmware (parser, mailbox, runner) and proves nothing about a
// real board.

import {
  PARAMS_AT,
  type Handlers,
  type Reply,
  batteryHandler,
  createDispatch,
  motionHandlers,
  createParser,
} from './dispatch.ts';
import { type OwnTimeServos, createOwnTimeServos, TICK_MS } from './servos.ts';
import { readUint16, uint16, createGroupStore, openLayout, decodeFrame } from './groupStore.ts';
import type { Work } from './agenda.ts';
import { COMMAND_NUMBER, type Frame } from '../codec/commands.ts';
import { createBatterySampler, createMailbox, createMainLoop, createSlots } from './mainLoop.ts';
import { type Engine, type EngineParts, createPanel } from './engine.ts';
import { createRunner, type RunReports } from './runner.ts';

// How fast groups are played (X3): a percentage for each, lost at power-off.

export interface Speeds {
  /** `group` 255 means all. A speed of 0 is not documented and changes nothing. */
  readonly set: (group: number, percent: number) => void;
  /** What becomes of a frame's time. */
  readonly played: (group: number, durationMs: number) => number;
}

const ALL_GROUPS = 255;
const GROUP_COUNT = 256;
const USUAL_PERCENT = 100;

function createSpeeds(): Speeds {
  const percents = new Array<number>(GROUP_COUNT).fill(USUAL_PERCENT);
  return {
    set(group, percent) {
      if (percent === 0) return;
      if (group === ALL_GROUPS) percents.fill(percent);
      else percents[group] = percent;
    },
    played: (group, durationMs) =>
      Math.round((durationMs * USUAL_PERCENT) / (percents[group] ?? USUAL_PERCENT)),
  };
}

// The commands that only the closed boards have (boards.md 2.3): speed of a group, release of servos, their
// positions.

const SET_SPEED = 11;
const RELEASE = 20;
const READ_POSITIONS = 21;
/** Querying six servos takes up to 450 ms (X7). */
const READ_POSITION_MS = 75;

function closedHandlers(slot: Uint8Array, speeds: Speeds): Handlers {
  function* setSpeed(): Work {
    yield* [];
    speeds.set(slot[PARAMS_AT] ?? 0, readUint16(slot, PARAMS_AT + 1));
  }

  return new Map([[SET_SPEED, setSpeed]]);
}

interface TorqueParts {
  readonly slot: Uint8Array;
  readonly servos: OwnTimeServos;
  readonly servoCount: number;
  readonly reply: Reply;
}

function torqueHandlers({ slot, servos, servoCount, reply }: TorqueParts): Handlers {
  /** Those of the packet's servos that are there. */
  function named(): number[] {
    const listAt = PARAMS_AT + 1;
    const list = slot.slice(listAt, listAt + (slot[PARAMS_AT] ?? 0));
    return [...list].filter((servo) => servo >= 1 && servo <= servoCount);
  }

  /** The simulated arm has no weight: it stays where it is until a hand turns it. */
  function* release(): Work {
    yield* [];
    named().forEach(servos.release);
  }

  function* readPositions(): Work {
    const present = named();
    if (present.length === 0) return;
    yield present.length * READ_POSITION_MS;
    const entries = present.flatMap((servo) => [servo, ...uint16(servos.pulse(servo))]);
    yield* reply(READ_POSITIONS, [present.length, ...entries]);
  }

  return new Map([
    [RELEASE, release],
    [READ_POSITIONS, readPositions],
  ]);
}

/** What differs between the closed boards. */
export interface ClosedTraits {
  readonly position: { readonly min: number; readonly max: number };
  /** Where its servos are at power-up; null for pins without pulses (X4). */
  readonly start: number | null;
  /** This servo number means all of them. */
  readonly broadcast: number | null;
  /** Its servos can be released and queried for their position (X7). */
  readonly talksToServos: boolean;
}

/** Natural end on these boards; the same number as the open firmware's erase (boards.md 2.4). */
const FINISHED = 8;

export function createClosedEngine(traits: ClosedTraits, parts: EngineParts): Engine {
  const { now, reply, servoCount } = parts;
  const slots = createSlots();
  const speeds = createSpeeds();
  const servos = createOwnTimeServos(servoCount, {
    tickMs: TICK_MS,
    targetOf: (_, position) =>
      position < traits.position.min || position > traits.position.max ? null : position,
    startOf: () => traits.start,
    broadcast: traits.broadcast,
  });
  const mailbox = createMailbox();
  const { slot } = mailbox;
  const store = createGroupStore(parts.chip, parts.sectorMs, openLayout(servoCount));
  store.preload(preloadedGroups(traits.position, servoCount));

  function storedFrame(group: number, frameIndex: number): Frame | null {
    return decodeFrame(store.readFrame(group, frameIndex), servoCount);
  }

  function playedFrame(group: number, frameIndex: number): Frame | null {
    const frame = storedFrame(group, frameIndex);
    return frame && { ...frame, durationMs: speeds.played(group, frame.durationMs) };
  }

  function* issue({ durationMs, targets }: Frame): Work {
    yield* [];
    for (const { servo, position } of targets) servos.accept(servo, position, durationMs);
  }

  const runner = createRunner({
    now,
    frameCount: store.frameCount,
    frame: playedFrame,
    issue,
    reports: runReports(reply),
    chainedSlot: null,
  });
  const panel = createPanel((group) => runner.request(group, 1));
  const serve = createDispatch(
    slot,
    motionHandlers({ slot, servos, runner, reply }, false),
    batteryHandler(createBatterySampler(slots, parts.batteryMv), reply),
    closedHandlers(slot, speeds),
    traits.talksToServos ? torqueHandlers({ slot, servos, servoCount, reply }) : new Map(),
  );
  return {
    takeByte: createParser(mailbox.put),
    sources: [createMainLoop({ now, slots, servos, mailbox, runner, panel, serve })],
    press: panel.press,
    turn: servos.turn,
    pulse: servos.pulse,
    target: servos.target,
    frameCount: store.frameCount,
    storedFrame,
    runningSlot: runner.runningSlot,
    dueFrame: runner.dueFrame,
  };
}

/** Whatever started the run (X1, boards.md 2.4). */
function runReports(reply: (command: number, params: readonly number[]) => Work): RunReports {
  return {
    started: (group, times) => reply(COMMAND_NUMBER.run, [group, ...uint16(times)]),
    stopped: () => reply(COMMAND_NUMBER.stop, []),
    ended: (group, times) => reply(FINISHED, [group, ...uint16(times)]),
  };
}

/** Something to run: on these boards groups come from another program over another cable (X6). */
function preloadedGroups({ min, max }: ClosedTraits['position'], servoCount: number) {
  const at = (share: number, durationMs: number): Frame => ({
    durationMs,
    targets: Array.from({ length: servoCount }, (_, index) => ({
      servo: index + 1,
      position: Math.round(min + (max - min) * share),
    })),
  });
  return new Map<number, readonly Frame[]>([
    [0, [at(0.5, 1000)]],
    [1, [at(0.4, 500), at(0.6, 500)]],
    [2, [at(0.45, 300), at(0.5, 300), at(0.55, 300), at(0.5, 300)]],
    [8, [at(0.3, 1000), at(0.7, 1000)]],
    [100, [at(0.4, 800), at(0.5, 800)]],
  ]);
}
