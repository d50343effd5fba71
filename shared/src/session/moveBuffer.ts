// The newest wish per servo, merged until the wire is free. Knows no time and no link; what it hands out is one move the
// family can take in one packet.

import type { Command, ServoTarget } from '../protocol/commands.ts';
import type { Family } from '../protocol/families.ts';
import { wireMs } from '../protocol/packet.ts';

export type MoveCommand = Extract<Command, { kind: 'move' }>;

export interface MoveBuffer {
  /** `durationMs` 0: as fast as the link allows. Merged wishes take the longest duration of any of them. */
  put(targets: readonly ServoTarget[], durationMs: number): void;
  take(): MoveCommand | null;
  isEmpty(): boolean;
  clear(): void;
}

export function createMoveBuffer(family: Family): MoveBuffer {
  const wishes = new Map<number, number>();
  let durationMs = 0;

  return {
    put(targets, wantedMs) {
      for (const { servo, position } of targets) wishes.set(servo, position);
      durationMs = Math.max(durationMs, wantedMs);
    },
    take() {
      if (wishes.size === 0) return null;
      const targets = [...wishes]
        .slice(0, family.servosPerMove)
        .map(([servo, position]) => ({ servo, position }));
      for (const { servo } of targets) wishes.delete(servo);
      const move: MoveCommand = {
        kind: 'move',
        targets,
        durationMs: Math.max(durationMs, intervalMs(targets, family)),
      };
      if (wishes.size === 0) durationMs = 0;
      return move;
    },
    isEmpty: () => wishes.size === 0,
    clear() {
      wishes.clear();
      durationMs = 0;
    },
  };
}

/** Time until the next packet of this size can take effect: shorter moves would make the servo stop and go. */
function intervalMs(targets: readonly ServoTarget[], family: Family): number {
  const packetBytes = 7 + 3 * targets.length;
  return Math.max(family.shortestMoveMs, Math.ceil(wireMs(packetBytes) + family.serviceGapMs));
}
