// What the host can ask of a board, as values. Knows no bytes, no board limits, no time: encode.ts turns these into
// packets and refuses what the connected board cannot take. Source: protocol document (boards.md section 1), and for what only
// some families have, section 2.3.

/** One servo's target. `position` is in the board's unit: pulse width in µs, or steps of a bus servo. */
export interface ServoTarget {
  readonly servo: number;
  readonly position: number;
}

/** One frame of an action group: targets reached together after `durationMs`. A frame without targets is a pause. */
export interface Frame {
  readonly durationMs: number;
  readonly targets: readonly ServoTarget[];
}

export type Command =
  | { readonly kind: 'move'; readonly durationMs: number; readonly targets: readonly ServoTarget[] }
  /** Plays the group in `slot`; `times` 0 repeats until stopped. */
  | { readonly kind: 'run'; readonly slot: number; readonly times: number }
  /** Ends a running group after its frame in progress (S50): not an emergency stop. */
  | { readonly kind: 'stop' }
  /** Erases every slot, whatever its parameter byte says (S19). */
  | { readonly kind: 'erase' }
  | { readonly kind: 'readBattery' }
  /** Stores frame `frameIndex` (0-based, S33) of `frameCount` in `slot`. */
  | {
      readonly kind: 'download';
      readonly slot: number;
      readonly frameCount: number;
      readonly frameIndex: number;
      readonly frame: Frame;
    }
  /** Group speed in percent of how it was stored, until power-off (X3); `slot` null for every group. */
  | { readonly kind: 'setSpeed'; readonly slot: number | null; readonly percent: number }
  /** Takes the torque off: what these servos carry drops. Any move powers them again (X7). */
  | { readonly kind: 'release'; readonly servos: readonly number[] }
  /** Up to 450 ms for six servos (X7). */
  | { readonly kind: 'readPositions'; readonly servos: readonly number[] }
  | { readonly kind: 'readVersion' }
  | { readonly kind: 'readAllPositions' }
  /** The trims it keeps in flash. */
  | { readonly kind: 'readOffsets' };

export type MoveCommand = Extract<Command, { kind: 'move' }>;
/** Stores one frame. */
export type FrameCommand = Extract<Command, { kind: 'download' }>;

export type CommandKind = Command['kind'];

/** Neither moves anything nor changes what a group does: any client may send it at any time. */
const HARMLESS: readonly CommandKind[] = [
  'stop',
  'readBattery',
  'readPositions',
  'readAllPositions',
  'readVersion',
  'readOffsets',
];

export function isHarmless({ kind }: Pick<Command, 'kind'>): boolean {
  return HARMLESS.includes(kind);
}

/** On the wire, in place of a slot: every group. */
export const ALL_GROUPS = 0xff;

/** Command numbers on the wire. */
export const COMMAND_NUMBER: Readonly<Record<CommandKind, number>> = {
  move: 3,
  run: 6,
  stop: 7,
  erase: 8,
  readBattery: 15,
  download: 25,
  setSpeed: 11,
  release: 20,
  readPositions: 21,
  readVersion: 1,
  readAllPositions: 13,
  readOffsets: 2,
};

/** Targets in ascending servo order, each servo once; the last one given wins. */
export function sortedTargets<T extends ServoTarget>(targets: readonly T[]): readonly T[] {
  const byServo = new Map(targets.map((target) => [target.servo, target]));
  return [...byServo.values()].sort((one, other) => one.servo - other.servo);
}
