// Board families as data: what a board of each kind takes, answers and means. One table for codec, session, simulator and
// page; behaviour that differs between boards is a row here, never an `if` elsewhere. Source: boards.md section 2.

import type { CommandKind } from './commands.ts';

export interface Range {
  readonly min: number;
  readonly max: number;
}

export interface Family {
  readonly id: FamilyId;
  /** Shown to people; a proper name, the same in every language. */
  readonly name: string;
  readonly unit: 'us' | 'steps';
  readonly position: Range;
  /** Centre of the position range, where a servo is at rest. */
  readonly centre: number;
  /** Servo numbers the board accepts in a packet. */
  readonly servo: Range;
  /** How many servos such a robot usually has, numbered from 1: the sliders of the page. */
  readonly usualServoCount: number;
  readonly servosPerMove: number;
  readonly servosPerFrame: number;
  /** Move and frame time. Shorter moves take the minimum step of the board, longer ones are cut by it (S25). */
  readonly durationMs: Range;
  readonly shortestMoveMs: number;
  readonly framesPerGroup: number;
  readonly slot: Range;
  readonly runTimes: Range;
  /** Largest LEN that is safe to send. */
  readonly maxLength: number;
  readonly commands: readonly CommandKind[];
  /** Commands the board answers; the others are silent by design. */
  readonly answers: readonly CommandKind[];
  /** What an empty packet 7 says: opposite things per family (boards.md 2.4). */
  readonly emptySeven: 'runFinished' | 'runStopped' | 'unknown';
  /** Pause the board needs between two packets, after the last byte has left the wire (S52, S54). */
  readonly serviceGapMs: number;
}

export type FamilyId = 'doc' | 'openarm-new' | 'lsc-16' | 'bus-ctrl';
