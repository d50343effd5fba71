// What every simulated firmware is, seen from its cable, what it gets to be built from, and the key and pad at the board: a group started
// there (S55, S56, X8), and the pad's receiver, which the main loop reads bit by bit every 50 ms and does nothing else meanwhile (S52).

import type { Frame } from '../codec/commands.ts';
import { type Source, type Work, noWork } from './agenda.ts';
import type { FlashChip } from './groupStore.ts';

export interface EngineParts {
  /** Milliseconds since this firmware was switched on. */
  readonly now: () => number;
  readonly chip: FlashChip;
  readonly sectorMs: number;
  readonly servoCount: number;
  readonly batteryMv: number;
  /** A hand-held pad's receiver is plugged in, found at power-up. */
  readonly hasPad?: boolean;
  readonly reply: (command: number, params: readonly number[]) => Work;
  /** Text on the line, in plain ASCII. */
  readonly print: (text: string) => Work;
}

export interface Engine {
  /** One byte at the pin, as the interrupt takes it. */
  readonly takeByte: (byte: number) => void;
  /** What it does by itself; the first one first where two are due at once. */
  readonly sources: readonly Source[];
  /** A person starts a group at the board. */
  readonly press: (press: Press) => void;
  /** A person presses the key that chooses what the board listens to, where it has one (L2). */
  readonly pressMode?: () => void;
  /** A hand turns a servo, where its torque can be off. */
  readonly turn?: (servo: number, position: number) => void;
  readonly pulse: (servo: number) => number;
  readonly target: (servo: number) => number;
  readonly frameCount: (slot: number) => number;
  readonly storedFrame: (slot: number, frameIndex: number) => Frame | null;
  readonly runningSlot: () => number | null;
  /** The frame of the running group that begins within so many milliseconds, where its groups have deadlines. */
  readonly dueFrame?: (withinMs: number) => Frame | null;
}

export type CreateEngine = (parts: EngineParts) => Engine;

export interface Press {
  readonly slot: number;
  /** How long the button blocks the loop while it is looked at: 60 ms for the key (S55), 5.2 ms for a pad's poll (S52). */
  readonly blockMs: number;
}

export interface Panel {
  readonly press: (press: Press) => void;
  readonly dueMs: () => number;
  /** What one pass of the main loop does for it. */
  readonly step: () => Work;
}

/** `start` runs the group once, as a command would. */
export function createPanel(start: (slot: number) => Work): Panel {
  const pressed: Press[] = [];

  function* step(): Work {
    const press = pressed.shift();
    if (!press) return;
    yield press.blockMs;
    yield* start(press.slot);
  }

  return {
    press: (press) => void pressed.push(press),
    dueMs: () => (pressed.length > 0 ? 0 : Infinity),
    step,
  };
}

// The receiver of a hand-held pad, read bit by bit every 50 ms: the main loop does nothing else meanwhile, so ticks
// and packets wait (S52).

export interface PadPoll {
  /** What is left of the poll that an idle loop began by itself before something woke it. */
  readonly begun: () => Work;
  /** What one pass of the main loop does for it. */
  readonly step: () => Work;
}

const EVERY_MS = 50;

export const NO_PAD_POLL: PadPoll = { begun: noWork, step: noWork };

/** Each poll takes `blockMs`. */
export function createPadPoll(now: () => number, blockMs: number): PadPoll {
  let nextMs = now() + EVERY_MS;

  function* begun(): Work {
    const overdue = now() - nextMs - blockMs;
    if (overdue > 0) nextMs += Math.ceil(overdue / (EVERY_MS + blockMs)) * (EVERY_MS + blockMs);
    if (nextMs >= now()) return;
    const endsMs = nextMs + blockMs;
    nextMs = endsMs + EVERY_MS;
    yield endsMs - now();
  }

  function* step(): Work {
    if (now() < nextMs) return;
    yield blockMs;
    nextMs = now() + EVERY_MS;
  }

  return { begun, step };
}
