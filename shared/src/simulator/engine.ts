// What every simulated firmware is, seen from its cable, and what it gets to be built from. Knows no firmware.

import type { Frame } from '../codec/commands.ts';
import type { Source, Work } from './agenda.ts';
import type { FlashChip } from './groupStore.ts';
import type { Press } from './panel.ts';

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
  /** Somebody starts a group at the board. */
  readonly press: (press: Press) => void;
  /** Somebody presses the key that says whom the board listens to, where it has one (L2). */
  readonly pressMode?: () => void;
  /** A hand turns a servo, where its torque can be off. */
  readonly turn?: (servo: number, position: number) => void;
  readonly pulse: (servo: number) => number;
  readonly target: (servo: number) => number;
  readonly frameCount: (slot: number) => number;
  readonly storedFrame: (slot: number, frameIndex: number) => Frame | null;
  readonly runningSlot: () => number | null;
}

export type CreateEngine = (parts: EngineParts) => Engine;
