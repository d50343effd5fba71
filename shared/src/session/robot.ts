// What the session believes of the robot: the motion estimate fed with what left the wire, the groups it stored itself,
// and how slow a servo's first move must be. Knows the clock; no link, no queue.

import type { Clock } from '../clock.ts';
import { takenOver, type MotionBefore } from '../motion/before.ts';
import {
  advance,
  afterCommand,
  afterEnd,
  afterReport,
  forgotten,
  gentleMs,
  hears,
  holdMove,
  passMs,
  positionAt,
  remainingMs,
  targetOf,
  unheldServos,
  UNKNOWN_MOTION,
  type KnownBoard,
} from '../motion/motion.ts';
import type { Command, Frame } from '../protocol/commands.ts';
import type { Family } from '../protocol/families.ts';
import type { Report } from '../protocol/reports.ts';
import { createGroupMemory } from './groupMemory.ts';
import type { MoveCommand } from './moveBuffer.ts';
import type { Motions } from './state.ts';
import { FIRST_MOVE_MS } from './timings.ts';

export interface RobotEstimate {
  /** A command's last bit left the wire just now. */
  applied(command: Command): void;
  /** The board said something just now; the end of a group is told by `groupEnded`. */
  heard(report: Report): void;
  motions(): Motions;
  /** Nobody has moved it, and the board has not said where it stands. */
  isUnknown(servo: number): boolean;
  /** The move with the duration its unknown servos need (safety.md: first move). */
  softened(move: MoveCommand): MoveCommand;
  hold(): MoveCommand | null;
  /** Servos that a hold cannot freeze now. */
  unheld(): readonly number[];
  moving(): boolean;
  /** The board played its group to the end: the one in `slot`, or null where nobody says which. */
  groupEnded(slot: number | null): void;
  stored(slot: number, frames: readonly Frame[]): void;
  /** What is in `slot` is no longer what we stored; without a slot, in all of them. */
  unstored(slot?: number): void;
  storedSlots(): readonly number[];
  /** Milliseconds that one pass of the group takes at most, or null when its frames are unknown. */
  groupMs(slot: number): number | null;
  /** Nothing is known any more: the board may have moved or restarted behind our back. */
  forget(): void;
  /** What others, who saw it move, know of it just now. */
  placed(before: MotionBefore): void;
}

export function createRobotEstimate(family: Family, clock: Clock): RobotEstimate {
  const memory = createGroupMemory();
  const board: KnownBoard = { family, playedFrames: memory.playedFrames };
  let motion = UNKNOWN_MOTION;

  const now = (): typeof motion => (motion = advance(motion, clock.now(), board));

  /** A frame of a known group that is due was begun from what was stored until now. */
  function changeMemory(change: () => void): void {
    now();
    change();
  }

  function isUnknown(servo: number): boolean {
    return targetOf(now(), servo) === null && positionAt(now(), servo, clock.now()) === null;
  }

  return {
    applied(command) {
      const isHeard = hears(now(), clock.now());
      motion = afterCommand(motion, command, clock.now(), board);
      if (command.kind !== 'setSpeed') return;
      memory.setSpeed(command.slot, isHeard ? command.percent : null);
    },
    heard: (report) => (motion = afterReport(motion, report, clock.now(), board)),
    motions() {
      const nowMs = clock.now();
      const known = advance(motion, nowMs, board);
      motion = known;
      return (servo) => ({ target: targetOf(known, servo), estimated: positionAt(known, servo, nowMs) });
    },
    isUnknown,
    softened(move) {
      const servos = move.targets.map(({ servo }) => servo);
      const isNew = servos.some((servo) => isUnknown(servo));
      const gentle = isNew ? Infinity : gentleMs(now(), servos, clock.now(), family);
      const needsMs = Math.min(FIRST_MOVE_MS, gentle);
      return move.durationMs >= needsMs ? move : { ...move, durationMs: needsMs };
    },
    hold() {
      const hold = holdMove(now(), clock.now(), family);
      return hold && { kind: 'move', ...hold };
    },
    unheld: () => unheldServos(now(), clock.now()),
    moving: () => now().run !== null || remainingMs(now(), clock.now()) > 0,
    groupEnded: (slot) => (motion = afterEnd(motion, slot, clock.now(), board)),
    stored: (slot, frames) => changeMemory(() => memory.store(slot, frames)),
    unstored: (slot) => changeMemory(() => memory.clear(slot)),
    storedSlots: memory.slots,
    groupMs(slot) {
      const frames = memory.playedFrames(slot);
      return frames && passMs(frames, board);
    },
    forget() {
      memory.forgetSpeeds();
      motion = forgotten(motion, clock.now());
    },
    placed: (before) => (motion = takenOver(now(), before, clock.now(), family)),
  };
}
