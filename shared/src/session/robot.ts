// What the session believes of the robot: the motion estimate fed with what left the wire, the groups it stored itself,
// and how slow a servo's first move must be. Knows the clock; no link, no queue.

import type { Clock } from '../clock.ts';
import {
  advance,
  afterMove,
  afterRun,
  afterStop,
  holdMove,
  positionAt,
  remainingMs,
  targetOf,
  UNKNOWN_MOTION,
} from '../motion/motion.ts';
import type { Command, Frame, ServoTarget } from '../protocol/commands.ts';
import type { Family } from '../protocol/families.ts';
import type { MoveCommand } from './moveBuffer.ts';
import type { ServoMotion } from './state.ts';
import { FIRST_MOVE_MS } from './timings.ts';

export interface RobotEstimate {
  /** A command's last bit left the wire just now. */
  applied(command: Command): void;
  motion(servo: number): ServoMotion;
  /** The move with the duration its unknown servos need (safety.md: first move). */
  softened(move: MoveCommand): MoveCommand;
  hold(): MoveCommand | null;
  moving(): boolean;
  /** The board played its group to the end. */
  groupEnded(): void;
  stored(slot: number, frames: readonly Frame[]): void;
  /** What is in `slot` is no longer what we stored; without a slot, in all of them. */
  unstored(slot?: number): void;
  storedSlots(): readonly number[];
  /** Milliseconds that one pass of the group takes, or null when its frames are unknown. */
  groupMs(slot: number): number | null;
  /** Nothing is known any more: the board may have moved or restarted behind our back. */
  forget(): void;
}

export function createRobotEstimate(family: Family, clock: Clock): RobotEstimate {
  const groups = new Map<number, readonly Frame[]>();
  let motion = UNKNOWN_MOTION;

  const now = (): typeof motion => (motion = advance(motion, clock.now(), family));

  function apply(command: Command): void {
    const current = now();
    const atMs = clock.now();
    if (command.kind === 'move')
      motion = afterMove(current, command.targets, command.durationMs, atMs, family);
    if (command.kind === 'run')
      motion = afterRun(current, groups.get(command.slot) ?? null, command.times, atMs);
    if (command.kind === 'stop') motion = afterStop(current);
    if (command.kind === 'release') motion = UNKNOWN_MOTION; // it drops, who knows where to
  }

  const isUnknown = ({ servo }: ServoTarget): boolean => positionAt(now(), servo, clock.now()) === null;

  return {
    applied: apply,
    motion: (servo) => ({ target: targetOf(now(), servo), estimated: positionAt(now(), servo, clock.now()) }),
    softened(move) {
      const newcomer = move.targets.some(
        (target) => isUnknown(target) && targetOf(now(), target.servo) === null,
      );
      const underWay = [...now().tracks.keys()].some((servo) => isUnknown({ servo, position: 0 }));
      const needsMs = newcomer ? FIRST_MOVE_MS : underWay ? Math.ceil(remainingMs(now(), clock.now())) : 0;
      return move.durationMs >= needsMs ? move : { ...move, durationMs: needsMs };
    },
    hold() {
      const hold = holdMove(now(), clock.now(), family);
      return hold && { kind: 'move', ...hold };
    },
    moving: () => now().run !== null || remainingMs(now(), clock.now()) > 0,
    groupEnded: () => (motion = afterStop(now())),
    stored: (slot, frames) => groups.set(slot, frames),
    unstored(slot) {
      if (slot === undefined) groups.clear();
      else groups.delete(slot);
    },
    storedSlots: () => [...groups.keys()].sort((a, b) => a - b),
    groupMs: (slot) => groups.get(slot)?.reduce((sum, frame) => sum + frame.durationMs, 0) ?? null,
    forget() {
      motion = UNKNOWN_MOTION;
    },
  };
}
