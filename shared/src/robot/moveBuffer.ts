// Moves of the page on their way: the newest value of each servo is merged until the wire is free, and servos of unknown position start one
// after another. What is taken out is one move that the family can take in one packet. Knows no link.

import type { Clock } from '../clock.ts';
import type { MoveCommand, ServoTarget } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import { moveBytes, wireMs } from '../codec/packet.ts';
import type { Core } from './core.ts';
import { encodeOrRefuse, refuseUnfit, requireReleased } from './rules.ts';
import { FIRST_MOVE_STAGGER_MS } from './timings.ts';

export interface Moves {
  put(targets: readonly ServoTarget[], durationMs: number): void;
  /** The newest move, or null when there is nothing to say. */
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
  const buffer = createMoveBuffer(family, servosPerMove);
  const firstMoves = createFirstMoves({
    ...{ clock, isUnknown: estimate.isUnknown, due: queue.wake, waiting: showWaiting },
  });

  function showWaiting(waitingToStart: readonly number[]): void {
    if (waitingToStart.join() !== store.state.waitingToStart.join()) store.update({ waitingToStart });
  }

  return {
    put(targets, durationMs) {
      requireReleased(store.state);
      for (const target of targets) refuseUnfit({ kind: 'move', targets: [target], durationMs }, family);
      buffer.put(targets, durationMs);
      queue.wake();
    },
    take() {
      const servos = firstMoves.next(buffer.servos());
      if (servos.length === 0) return null;
      const { move, swift } = buffer.take(servos);
      return encodeOrRefuse(estimate.softened(move, swift), family);
    },
    servos: buffer.servos,
    startsWithinMs: (servos) => firstMoves.startsWithinMs([...new Set([...buffer.servos(), ...servos])]),
    clear() {
      buffer.clear();
      showWaiting([]);
    },
    drop: buffer.drop,
  };
}

interface NewestMove {
  readonly move: MoveCommand;
  /** Servos whose value named no time: they go as fast as the soft limit and the link allow. */
  readonly swift: readonly number[];
}

interface MoveBuffer {
  /** `durationMs` 0: as fast as the soft limit and the link allow. */
  put(targets: readonly ServoTarget[], durationMs: number): void;
  /** Servos with a value that waits, in the order they were first moved. */
  servos(): readonly number[];
  clear(): void;
  drop(servos: readonly number[]): void;
  /** As many values of these servos as one packet takes, in the longest duration of any of them. */
  take(servos: readonly number[]): NewestMove;
}

function createMoveBuffer(family: Family, servosPerMove: number): MoveBuffer {
  const newest = new Map<number, { readonly position: number; readonly durationMs: number }>();

  return {
    put(targets, durationMs) {
      for (const { servo, position } of targets) newest.set(servo, { position, durationMs });
    },
    servos: () => [...newest.keys()],
    take(servos) {
      const taken = [...newest]
        .filter(([servo]) => servos.includes(servo))
        .slice(0, servosPerMove)
        .map(([servo, value]) => ({ servo, ...value }));
      for (const { servo } of taken) newest.delete(servo);
      const targets = taken.map(({ servo, position }) => ({ servo, position }));
      const durationMs = Math.max(intervalMs(targets, family), ...taken.map((value) => value.durationMs));
      const swift = taken.filter((value) => value.durationMs === 0).map(({ servo }) => servo);
      return { move: { kind: 'move', targets, durationMs }, swift };
    },
    clear: () => newest.clear(),
    drop: (servos) => servos.forEach((servo) => newest.delete(servo)),
  };
}

/** Time until the next packet of this size can take effect: shorter moves would make the servo stop and go. */
function intervalMs(targets: readonly ServoTarget[], family: Family): number {
  return Math.max(family.shortestMoveMs, Math.ceil(wireMs(moveBytes(targets.length)) + family.serviceGapMs));
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
