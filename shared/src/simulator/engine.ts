// The board without its cable: parser, mailbox, main loop, servos, flash and runner put together (boards.md section 3).
// Knows no pacing and no clock; takes bytes as they arrive and hands its replies to whoever sends them.

import { COMMAND_NUMBER, type Frame } from '../protocol/commands.ts';
import type { Source } from './agenda.ts';
import { createDispatch } from './dispatch.ts';
import type { FlashChip } from './flashChip.ts';
import { createGroupStore } from './groupStore.ts';
import { createMailbox } from './mailbox.ts';
import { createMainLoop } from './mainLoop.ts';
import { createParser } from './parser.ts';
import { createRunner } from './runner.ts';
import { createServos, type Servos } from './servos.ts';
import { createSlots } from './slots.ts';
import { decodeFrame } from './storedFrame.ts';
import type { Work } from './work.ts';

export interface EngineParts {
  readonly now: () => number;
  readonly chip: FlashChip;
  readonly sectorMs: number;
  readonly servoCount: number;
  readonly batteryMv: number;
  readonly reply: (command: number, params: readonly number[]) => Work;
}

export interface Engine {
  /** One byte at the pin, as the interrupt takes it. */
  readonly takeByte: (byte: number) => void;
  readonly loop: Source;
  readonly servos: Servos;
  readonly frameCount: (slot: number) => number;
  readonly storedFrame: (slot: number, frameIndex: number) => Frame | null;
  readonly runningSlot: () => number | null;
}

/** Playback refuses more entries than this (S38), unless the board is configured for more servos. */
const SERVOS_PLAYED = 8;
/** A sample of the battery every so many slots of 10 ms; none before the first (S59). */
const SLOTS_PER_BATTERY_SAMPLE = 50;

export function createEngine({ now, chip, sectorMs, servoCount, batteryMv, reply }: EngineParts): Engine {
  const servosPlayed = Math.max(SERVOS_PLAYED, servoCount);
  const slots = createSlots();
  const servos = createServos(servoCount);
  const mailbox = createMailbox();
  const store = createGroupStore(chip, sectorMs, servosPlayed);

  function storedFrame(slot: number, frameIndex: number): Frame | null {
    return decodeFrame(store.readFrame(slot, frameIndex), servosPlayed);
  }

  function issue({ durationMs, targets }: Frame): void {
    for (const { servo, position } of targets) servos.accept(servo, position, durationMs);
  }

  function sampledMv(): number {
    return slots.taken() < SLOTS_PER_BATTERY_SAMPLE ? 0 : batteryMv;
  }

  const reportEnd = () => reply(COMMAND_NUMBER.stop, []);
  const runner = createRunner({ now, frameCount: store.frameCount, frame: storedFrame, issue, reportEnd });
  const serve = createDispatch({ slot: mailbox.slot, servos, store, runner, batteryMv: sampledMv, reply });
  return {
    takeByte: createParser(mailbox.put),
    loop: createMainLoop({ now, slots, servos, mailbox, runner, serve }),
    servos,
    frameCount: store.frameCount,
    storedFrame,
    runningSlot: runner.runningSlot,
  };
}
