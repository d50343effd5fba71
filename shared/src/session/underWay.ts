// Moves handed to a link that lets a newer one take their place: where those servos shall go is said again in each move until one
// that says it has left. Knows targets, order and their age; no link.

import type { Clock } from '../clock.ts';
import type { ServoTarget } from '../protocol/commands.ts';
import { OVERSLEPT_MS } from './timings.ts';

export interface UnderWay {
  /** These, and where the servos shall go that no move has told for sure. Null where that was asked too long ago to say again. */
  joined(targets: readonly ServoTarget[]): readonly ServoTarget[] | null;
  /** A move of all that `joined` gave is handed over. Returns what to call once it has left or failed; not where one took its place. */
  handed(targets: readonly ServoTarget[]): () => void;
  /** Another move says where these shall go. */
  supersede(targets: readonly ServoTarget[]): void;
  clear(): void;
}

interface Told {
  readonly position: number;
  readonly atMs: number;
  /** The first move that said so: any that leaves from there on says it, too. */
  readonly move: number;
}

export function createUnderWay(clock: Clock): UnderWay {
  const told = new Map<number, Told>();
  let lastMove = 0;

  return {
    joined(targets) {
      const asked = new Set(targets.map(({ servo }) => servo));
      const others = [...told].filter(([servo]) => !asked.has(servo));
      if (others.some(([, { atMs }]) => clock.now() - atMs > OVERSLEPT_MS)) return null;
      return [...targets, ...others.map(([servo, { position }]) => ({ servo, position }))];
    },
    handed(targets) {
      const move = (lastMove += 1);
      for (const { servo, position } of targets)
        if (told.get(servo)?.position !== position) told.set(servo, { position, atMs: clock.now(), move });
      return () => {
        for (const [servo, first] of told) if (first.move <= move) told.delete(servo);
      };
    },
    supersede(targets) {
      for (const { servo } of targets) told.delete(servo);
    },
    clear: () => told.clear(),
  };
}
