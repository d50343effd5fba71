// What a board says, as values. The same number means different things per family, so a report is chosen by command
// number, LEN and family together (boards.md 2.4), never by "the next packet is my answer".

import type { ServoTarget } from './commands.ts';

/** One servo's trim, in the board's unit. */
export interface ServoOffset {
  readonly servo: number;
  readonly offset: number;
}

export type Report =
  /** The board took a run command. Proves reception only: it comes before the slot is looked up (S18). */
  | { readonly kind: 'runAccepted' }
  /** A group started, whichever client began it (LSC family). */
  | { readonly kind: 'runStarted'; readonly slot: number; readonly times: number }
  /** A group ended by itself; `slot` where the board names it. */
  | { readonly kind: 'runFinished'; readonly slot: number | null }
  /** A running group was stopped. */
  | { readonly kind: 'runStopped' }
  | { readonly kind: 'erased' }
  | { readonly kind: 'battery'; readonly batteryMv: number }
  /** A download frame was handled; comes after the flash work, success or not (S20). */
  | { readonly kind: 'frameStored' }
  /** Where bus servos stand; turned by hand, one can stand a little below 0. */
  | { readonly kind: 'positions'; readonly positions: readonly ServoTarget[] }
  /** Where the board has its servos, all of them (LeArm). */
  | { readonly kind: 'allPositions'; readonly positions: readonly ServoTarget[] }
  /** What the board adds to the positions of its servos (LeArm). */
  | { readonly kind: 'offsets'; readonly offsets: readonly ServoOffset[] }
  /** Which servos the board drives, by the unit they count in, and its firmware. */
  | { readonly kind: 'version'; readonly unit: 'us' | 'steps'; readonly version: number }
  /** Well-formed on the wire, but not a report this family is known to send. */
  | { readonly kind: 'unknown'; readonly command: number; readonly params: Uint8Array };

/** What the board drives, by the number in its version report. */
export const SERVO_TYPES = [null, 'us', 'steps'] as const;

export type ReportKind = Report['kind'];
