// Moves of the page on their way: the newest value of each servo is merged until the wire is free, and servos of unknown position start one
// after another. What is taken out is one move that the family can take in one packet. Knows no link.

import type { Clock } from '../clock.ts';
import type { ServoTarget } from '../codec/commands.ts';
import type { ServoOrder } from '../motion/parts.ts';
import type { Core } from './core.ts';
import { LinkError } from './linkError.ts';
import { encodeOrRefuse, refuseUnfit, requireReleased } from './rules.ts';
import { FIRST_MOVE_STAGGER_MS } from './timings.ts';

export interface Moves {
  put(targets: readonly ServoTarget[], durationMs: number): void;
  /** The newest move, or the next part of those under way; null when there is nothing to say. */
  take(): Uint8Array | null;
  /** Servos with a value that is still to leave, in the order they were first moved. */
  servos(): readonly number[];
  /** Until the last of those that wait and of these may start. */
  startsWithinMs(servos: readonly number[]): number;
  clear(): void;
  /** These have no value any more. */
  drop(servos: readonly number[]): void;
}

export function createMoves({ family, clock, store, estimate, queue, servosPerMove }: Core): Moves {
  const buffer = createMoveBuffer();
  let cancelTimer = (): void => undefined;
  const firstMoves = createFirstMoves({
    ...{ clock, isUnknown: estimate.isUnknown, due: queue.wake, waiting: showWaiting },
  });

  function showWaiting(waitingToStart: readonly number[]): void {
    if (waitingToStart.join() !== store.state.waitingToStart.join()) store.update({ waitingToStart });
  }

  /** Wakes the queue when the next part is due. */
  function planPart(): void {
    cancelTimer();
    const dueMs = estimate.partDueMs();
    if (dueMs < Infinity) cancelTimer = clock.after(Math.max(0, dueMs - clock.now()), queue.wake);
  }

  function clear(): void {
    buffer.clear();
    estimate.dropParts();
    cancelTimer();
    showWaiting([]);
  }

  return {
    put(targets, durationMs) {
      requireReleased(store.state);
      // A frame that nobody knows would make the servo faster, and the servo what that frame moves.
      if (estimate.groupMayRun()) throw new LinkError('busy', 'a group may run: end it first');
      for (const target of targets) refuseUnfit({ kind: 'move', targets: [target], durationMs }, family);
      buffer.put(targets, durationMs);
      queue.wake();
    },
    take() {
      // One began at the board while these waited.
      if (estimate.groupMayRun()) clear();
      const servos = firstMoves.next(buffer.servos()).slice(0, servosPerMove);
      const move = estimate.takePart(buffer.take(servos), servosPerMove);
      planPart();
      return move && encodeOrRefuse(move, family);
    },
    servos: buffer.servos,
    startsWithinMs: (servos) => firstMoves.startsWithinMs([...new Set([...buffer.servos(), ...servos])]),
    clear,
    drop(servos) {
      buffer.drop(servos);
      estimate.dropParts(servos);
    },
  };
}

interface MoveBuffer {
  /** `durationMs` 0: as fast as the soft limit and the link allow. */
  put(targets: readonly ServoTarget[], durationMs: number): void;
  /** Servos with a value that waits, in the order they were first moved. */
  servos(): readonly number[];
  clear(): void;
  drop(servos: readonly number[]): void;
  /** The values of these servos. */
  take(servos: readonly number[]): readonly ServoOrder[];
}

function createMoveBuffer(): MoveBuffer {
  const newest = new Map<number, ServoOrder>();

  return {
    put(targets, durationMs) {
      for (const target of targets) newest.set(target.servo, { ...target, durationMs });
    },
    servos: () => [...newest.keys()],
    take(servos) {
      const taken = [...newest.values()].filter(({ servo }) => servos.includes(servo));
      for (const { servo } of taken) newest.delete(servo);
      return taken;
    },
    clear: () => newest.clear(),
    drop: (servos) => servos.forEach((servo) => newest.delete(servo)),
  };
}

interface FirstMoveOptions {
  readonly clock: Clock;
  isUnknown(servo: number): boolean;
  /** Another one may start now. */
  due(): void;
  /** These are left, in the order they start in. */
  waiting(servos: readonly number[]): void;
}

interface FirstMoves {
  /** Of the servos that wait for the wire, those of the next move. Empty: none may start yet. */
  next(servos: readonly number[]): readonly number[];
  /** Until the last of them has started, if no others follow. */
  startsWithinMs(servos: readonly number[]): number;
}

/** Servos of unknown position start in a packet of their own, so that a person can see and stop what is about to happen. */
function createFirstMoves({ clock, isUnknown, due, waiting }: FirstMoveOptions): FirstMoves {
  let nextStartMs = -Infinity;
  let cancelTimer = (): void => undefined;

  const untilNextMs = (): number => Math.max(0, nextStartMs - clock.now());

  function start(first: number): readonly number[] {
    nextStartMs = clock.now() + FIRST_MOVE_STAGGER_MS;
    return [first];
  }

  return {
    next(servos) {
      const unknown = servos.filter(isUnknown);
      const [first] = unknown;
      const mayStart = first !== undefined && untilNextMs() === 0;
      const chosen = mayStart ? start(first) : servos.filter((servo) => !unknown.includes(servo));
      const left = unknown.filter((servo) => !chosen.includes(servo));
      cancelTimer();
      if (left.length > 0) cancelTimer = clock.after(untilNextMs(), due);
      waiting(left);
      return chosen;
    },
    startsWithinMs(servos) {
      const count = servos.filter(isUnknown).length;
      return count === 0 ? 0 : untilNextMs() + (count - 1) * FIRST_MOVE_STAGGER_MS;
    },
  };
}
