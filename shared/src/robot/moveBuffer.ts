// The newest wish per servo, merged until the wire is free. Knows no time and no link; what it hands out is one move the
// family can take in one packet.

import type { Command, ServoTarget } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import { wireMs } from '../codec/packet.ts';

export type MoveCommand = Extract<Command, { kind: 'move' }>;

export interface Wishes {
  readonly move: MoveCommand;
  /** Servos whose wish named no time: they go as fast as the soft limit and the link allow. */
  readonly swift: readonly number[];
}

export interface MoveBuffer {
  /** `durationMs` 0: as fast as the soft limit and the link allow. */
  put(targets: readonly ServoTarget[], durationMs: number): void;
  /** Servos with a wish, in the order they were first asked. */
  servos(): readonly number[];
  clear(): void;
  /** These have no wish any more. */
  drop(servos: readonly number[]): void;
  /** As many wishes of these servos as one packet takes, in the longest duration of any of them. */
  take(servos: readonly number[]): Wishes;
}

export function createMoveBuffer(family: Family, servosPerMove: number): MoveBuffer {
  const wishes = new Map<number, { readonly position: number; readonly durationMs: number }>();

  return {
    put(targets, durationMs) {
      for (const { servo, position } of targets) wishes.set(servo, { position, durationMs });
    },
    servos: () => [...wishes.keys()],
    take(servos) {
      const taken = [...wishes]
        .filter(([servo]) => servos.includes(servo))
        .slice(0, servosPerMove)
        .map(([servo, wish]) => ({ servo, ...wish }));
      for (const { servo } of taken) wishes.delete(servo);
      const targets = taken.map(({ servo, position }) => ({ servo, position }));
      const durationMs = Math.max(intervalMs(targets, family), ...taken.map((wish) => wish.durationMs));
      const swift = taken.filter((wish) => wish.durationMs === 0).map(({ servo }) => servo);
      return { move: { kind: 'move', targets, durationMs }, swift };
    },
    clear: () => wishes.clear(),
    drop: (servos) => servos.forEach((servo) => wishes.delete(servo)),
  };
}

/** Time until the next packet of this size can take effect: shorter moves would make the servo stop and go. */
export function intervalMs(targets: readonly ServoTarget[], family: Family): number {
  return Math.max(family.shortestMoveMs, Math.ceil(wireMs(moveBytes(targets.length)) + family.serviceGapMs));
}

export const moveBytes = (servoCount: number): number => 7 + 3 * servoCount;

/** As many servos as a move of that length names. */
export const servosIn = (bytes: number): number => Math.floor((bytes - moveBytes(0)) / 3);
