// LSC, Bus Servo Controller and xArm by their documents (boards.md chapter 5): their firmware is closed, so what nobody
// wrote down is the open firmware's way (parser, mailbox, runner) and proves nothing about a real board.

import { COMMAND_NUMBER, type Frame } from '../codec/commands.ts';
import { createBatterySampler } from './battery.ts';
import { closedHandlers, torqueHandlers } from './closedHandlers.ts';
import { batteryHandler, createDispatch, motionHandlers } from './dispatch.ts';
import type { Engine, EngineParts } from './engine.ts';
import { createGroupStore, openLayout } from './groupStore.ts';
import { createMailbox } from './mailbox.ts';
import { createMainLoop } from './mainLoop.ts';
import { createOwnTimeServos } from './ownTimeServos.ts';
import { createPanel } from './panel.ts';
import { createParser } from './parser.ts';
import { createRunner, type RunReports } from './runner.ts';
import { TICK_MS } from './servos.ts';
import { createSlots } from './slots.ts';
import { createSpeeds } from './speeds.ts';
import { decodeFrame, uint16 } from './storedFrame.ts';
import type { Work } from './work.ts';

/** What differs between the closed boards. */
export interface ClosedTraits {
  readonly position: { readonly min: number; readonly max: number };
  /** Where its servos are at power-up; null for pins without pulses (X4). */
  readonly start: number | null;
  /** This servo number means all of them. */
  readonly broadcast: number | null;
  /** Its servos can be released and asked for their position (X7). */
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
