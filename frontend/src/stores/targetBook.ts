// Each servo's target as the page shows it: what the session says was sent, and before that what was just asked for, so that
// a value does not jump back while its packet waits for the wire. Knows no session.

import type { Clock } from '#shared/clock.ts';
import type { ServoTarget } from '#shared/protocol/commands.ts';
import type { ServoMotion } from '#shared/session/state.ts';

export type Targets = Readonly<Record<number, number>>;

export interface TargetBook {
  wish(targets: readonly ServoTarget[]): void;
  clear(): void;
  /** How many servos were asked for something, at the last reading, that has not left yet. */
  waiting(): number;
  /** Targets of these servos; the very same object where nothing changed. Those that `queue` for their turn wait longer. */
  read(
    servos: readonly number[],
    motion: (servo: number) => ServoMotion,
    queue: readonly number[],
    before: Targets,
  ): Targets;
}

/** Longer than any packet waits for the wire once its turn has come; a wish that has not left by then was dropped. */
const WISH_LASTS_MS = 1000;

export function createTargetBook(clock: Clock): TargetBook {
  const wishes = new Map<number, { readonly position: number; readonly untilMs: number }>();

  function prolong(servo: number): void {
    const wish = wishes.get(servo);
    if (wish !== undefined) wishes.set(servo, { ...wish, untilMs: clock.now() + WISH_LASTS_MS });
  }

  function targetOf(servo: number, sent: number | null): number | null {
    const wish = wishes.get(servo);
    if (wish !== undefined && wish.position !== sent && clock.now() < wish.untilMs) return wish.position;
    wishes.delete(servo);
    return sent === null ? null : Math.round(sent);
  }

  return {
    wish(targets) {
      const untilMs = clock.now() + WISH_LASTS_MS;
      for (const { servo, position } of targets) wishes.set(servo, { position, untilMs });
    },
    clear: () => wishes.clear(),
    waiting: () => wishes.size,
    read(servos, motion, queue, before) {
      queue.forEach(prolong);
      const next: Record<number, number> = {};
      for (const servo of servos) {
        const target = targetOf(servo, motion(servo).target);
        if (target !== null) next[servo] = target;
      }
      return sameTargets(before, next) ? before : next;
    },
  };
}

function sameTargets(one: Targets, other: Targets): boolean {
  const servos = Object.keys(one);
  return (
    servos.length === Object.keys(other).length &&
    servos.every((servo) => one[Number(servo)] === other[Number(servo)])
  );
}
