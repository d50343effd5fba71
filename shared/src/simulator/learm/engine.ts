// LeArm AI with its ESP32 (boards.md chapter 4), PWM or bus servos, without its cable: parser, mode, loop, servos and store put
// together. Knows no pacing and no clock.

import type { Source, Work } from '../agenda.ts';
import { type Servos, createOwnTimeServos } from '../servos.ts';
import { HEADER } from '../../codec/packet.ts';
import type { Frame } from '../../codec/commands.ts';
import type { Engine, EngineParts } from '../engine.ts';
import { createGroupStore, decodeFrame } from '../groupStore.ts';
import { createProcessor } from '../mainLoop.ts';
import { createLearmCommands, LEARM_SERVOS, type LearmTraits, createLearmRunner } from './commands.ts';

// Moves LeArm's servos every 10 ms, whatever its loop is busy with. Sleeps while nothing moves.

const LEARM_TICK_MS = 10;

function createTicker(now: () => number, servos: Pick<Servos, 'moving' | 'tick'>): Source {
  let lastMs = -Infinity;
  let asleep = true;

  const gridAfter = (atMs: number) => (Math.floor(atMs / LEARM_TICK_MS) + 1) * LEARM_TICK_MS;

  function dueMs(): number {
    if (!servos.moving()) {
      asleep = true;
      return Infinity;
    }
    if (asleep) lastMs = now();
    asleep = false;
    return gridAfter(lastMs);
  }

  function fire(): void {
    lastMs = dueMs();
    servos.tick();
  }

  return { dueMs, fire };
}

// LeArm's byte parser (L3): no time-out, numbers from 26 on refused, a buffer of 60 bytes that is filled without
// looking. What the real one does to its memory then is not imitated: it says `overrun` and the board jams.

interface ParserEvents {
  readonly complete: (command: number, params: Uint8Array) => void;
  /** A byte was written behind the end of the buffer. */
  readonly overrun: () => void;
}

const BUFFER_BYTES = 60;
const FIRST_REFUSED = 26;
const BARE_LENGTH = 2;

export function createLearmParser({ complete, overrun }: ParserEvents): (byte: number) => void {
  let take = hunt();

  type State = (byte: number) => State;

  function hunt(headersSeen = 0): State {
    if (headersSeen === 2) return length;
    return (byte) => hunt(byte === HEADER ? headersSeen + 1 : 0);
  }

  function length(byte: number): State {
    return byte === 0 ? hunt() : (next) => command(byte, next);
  }

  function command(len: number, byte: number): State {
    if (len === BARE_LENGTH) {
      complete(byte, new Uint8Array());
      return hunt();
    }
    // LEN 1 cannot be, yet it waits for a byte.
    return byte >= FIRST_REFUSED ? hunt() : data(byte, Math.max(len - BARE_LENGTH, 1), []);
  }

  function data(number: number, wanted: number, params: number[]): State {
    return (byte) => {
      params.push(byte);
      if (params.length > BUFFER_BYTES) {
        overrun();
        return hunt();
      }
      if (params.length < wanted) return data(number, wanted, params);
      complete(number, Uint8Array.from(params));
      return hunt();
    };
  }

  return (byte) => void (take = take(byte));
}

/** 21 bytes a frame, 8 KiB a group, 255 groups (L12). */
export const LEARM_LAYOUT = { frameBytes: 21, groupBytes: 8192, groupCount: 255 };
/** The key K1 goes round; only in the second one the line is the USB's (L2). */
const MODES = ['app', 'pc', 'ps2', 'offline'] as const;
const FIRST_LINE_MS = 500;
const READY_MS = 2700;
/** Of a frame's time, one a poll (L7). */
const STEP_MS = 100;
const GRIPPER = 1;

export function createLearmEngine(traits: LearmTraits, parts: EngineParts): Engine {
  const { now, reply, print, sectorMs } = parts;
  const packets: { readonly command: number; readonly params: Uint8Array }[] = [];
  // A board that has been on for a while: the key was pressed already.
  let booted = now() >= READY_MS;
  let mode = MODES.indexOf(booted ? 'pc' : 'app');
  let jammed = false;

  function targetOf(servo: number, position: number): number {
    const { min, max } = servo === GRIPPER ? traits.gripper : traits.range;
    return Math.min(Math.max(position, min), max);
  }

  const servos = createOwnTimeServos(LEARM_SERVOS.length, {
    tickMs: LEARM_TICK_MS,
    targetOf,
    startOf: (servo) => traits.resetPose[servo - 1] ?? null,
    broadcast: null,
  });
  const store = createGroupStore(parts.chip, sectorMs, LEARM_LAYOUT);

  function storedFrame(slot: number, frameIndex: number): Frame | null {
    return decodeFrame(store.readFrame(slot, frameIndex), LEARM_SERVOS.length);
  }

  function issue({ durationMs, targets }: Frame): void {
    for (const { servo, position } of targets) servos.accept(servo, position, durationMs);
  }

  const runner = createLearmRunner({
    now,
    frameCount: store.frameCount,
    frame: storedFrame,
    issue,
    isOver: ({ durationMs }, polls) =>
      traits.endsFrames === 'arrived' ? !servos.moving() : polls * STEP_MS >= durationMs,
  });
  const serve = createLearmCommands({ traits, servos, store, runner, sectorMs, reply });
  const takeByte = createLearmParser({
    complete: (command, params) => packets.push({ command, params }),
    overrun: () => (jammed = true),
  });

  /** Text on the same line (L1). */
  function* boot(): Work {
    yield FIRST_LINE_MS;
    yield* print(`${traits.greeting}\r\n`);
    yield READY_MS - now();
    yield* print('begin\r\n');
    booted = true;
  }

  function* pass(): Work {
    if (!booted) yield* boot();
    const packet = packets.shift();
    if (packet) yield* serve(packet.command, packet.params);
    runner.step();
  }

  const loop = createProcessor({
    now,
    bootMs: 0,
    wantedMs: () => (booted && packets.length === 0 ? runner.dueMs() : 0),
    pass,
  });
  const alive = [createTicker(now, servos), loop];

  return {
    takeByte: (byte) => {
      if (booted && !jammed && MODES[mode] === 'pc') takeByte(byte);
    },
    // A jammed board only continues its last pulses.
    sources: alive.map(({ dueMs, fire }) => ({ dueMs: () => (jammed ? Infinity : dueMs()), fire })),
    // Its pad does nothing in PC mode.
    press: () => undefined,
    pressMode: () => void (mode = (mode + 1) % MODES.length),
    pulse: servos.pulse,
    target: servos.target,
    frameCount: (slot) => (slot < LEARM_LAYOUT.groupCount ? store.frameCount(slot) : 0),
    storedFrame,
    runningSlot: runner.runningSlot,
  };
}
