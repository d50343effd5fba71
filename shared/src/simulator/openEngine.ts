// The open firmware without its cable: parser, mailbox, main loop, servos, flash and runner put together (boards.md
// section 3). What differs between its builds is a value. Knows no pacing and no clock.

import { COMMAND_NUMBER, type Frame } from '../codec/commands.ts';
import { createBatterySampler, createMailbox, createMainLoop, createSlots } from './mainLoop.ts';
import { batteryHandler, createDispatch, motionHandlers, storeHandlers, createParser } from './dispatch.ts';
import { type Engine, type EngineParts, createPadPoll, NO_PAD_POLL, createPanel } from './engine.ts';
import { createGroupStore, openLayout, decodeFrame } from './groupStore.ts';
import { createRunner } from './runner.ts';
import { createServos } from './servos.ts';
import { noWork, type Work } from './agenda.ts';

/** What differs between the builds of the open firmware (boards.md 3.2). */
export interface OpenBuild {
  /** Answers a run before it looks the group up (S18). */
  readonly acksRun: boolean;
  /** Says when a group ended by itself (S48). */
  readonly reportsEnd: boolean;
  /** The group behind which the next one starts (S49). */
  readonly chainedSlot: number | null;
  /** Only the protocol document's board does: the open firmware reads the voltage and does not report it (S17). */
  readonly answersBattery: boolean;
  /** Every accepted move and frame goes to the bus servos, too, entry by entry (S31). */
  readonly copiesToBus: boolean;
  /** How long a query of the receiver of a hand-held pad takes (S52), and whether it is queried where none was found. */
  readonly padPollMs: number;
  readonly alwaysPolls: boolean;
}

/** Ten bytes at 115200 baud, sent by busy-waiting (S31). */
const BUS_ENTRY_MS = 0.87;
/** Playback refuses more entries than this (S38), unless the board is configured for more servos. */
const SERVOS_PLAYED = 8;

export function createOpenEngine(build: OpenBuild, parts: EngineParts): Engine {
  const { now, reply } = parts;
  const servosPlayed = Math.max(SERVOS_PLAYED, parts.servoCount);
  const slots = createSlots();
  const servos = createServos(parts.servoCount);
  const mailbox = createMailbox();
  const { slot } = mailbox;
  const store = createGroupStore(parts.chip, parts.sectorMs, openLayout(servosPlayed));

  function storedFrame(group: number, frameIndex: number): Frame | null {
    return decodeFrame(store.readFrame(group, frameIndex), servosPlayed);
  }

  const copyMs = (entries: number): number => (build.copiesToBus ? entries * BUS_ENTRY_MS : 0);

  function* issue({ durationMs, targets }: Frame): Work {
    for (const { servo, position } of targets) servos.accept(servo, position, durationMs);
    yield copyMs(targets.length);
  }

  const ended = build.reportsEnd ? () => reply(COMMAND_NUMBER.stop, []) : noWork;
  const runner = createRunner({
    now,
    frameCount: store.frameCount,
    frame: storedFrame,
    issue,
    reports: { started: noWork, stopped: noWork, ended },
    chainedSlot: build.chainedSlot,
  });
  const polls = build.alwaysPolls || (parts.hasPad ?? false);
  const padPoll = polls ? createPadPoll(now, build.padPollMs) : NO_PAD_POLL;
  const panel = createPanel((group) => runner.request(group, 1));
  const serve = createDispatch(
    slot,
    motionHandlers({ slot, servos, runner, reply, copyMs }, build.acksRun),
    storeHandlers({ slot, store, reply }),
    build.answersBattery ? batteryHandler(createBatterySampler(slots, parts.batteryMv), reply) : new Map(),
  );
  return {
    takeByte: createParser(mailbox.put),
    sources: [createMainLoop({ now, slots, servos, mailbox, runner, panel, padPoll, serve })],
    press: panel.press,
    pulse: servos.pulse,
    target: servos.target,
    frameCount: store.frameCount,
    storedFrame,
    runningSlot: runner.runningSlot,
    dueFrame: runner.dueFrame,
  };
}
