// The groups this session stored on the board and how fast the board plays them. Knows slots; not what runs.

import timings from '../../protocol/timings.json' with { type: 'json' };
import type { Frame } from '../codec/commands.ts';

export interface GroupMemory {
  store(slot: number, frames: readonly Frame[]): void;
  /** Without a slot, all of them. */
  clear(slot?: number): void;
  /** The board has erased all of them. */
  empty(): void;
  slots(): readonly number[];
  /** Without a slot, of every group (X3); without a percentage it is unknown whether the board took one. */
  setSpeed(slot: number | null, percent: number | null): void;
  /** The board may have lost its speeds with its power, or kept them. */
  forgetSpeeds(): void;
  /** With the times the board plays them in; empty where nothing is stored, null where the frames or the speed are unknown. */
  playedFrames(slot: number): readonly Frame[] | null;
}

const AS_STORED = timings.run.asStoredPercent;

export function createGroupMemory(): GroupMemory {
  const groups = new Map<number, readonly Frame[]>();
  const percents = new Map<number, number | null>();
  let usualPercent: number | null = AS_STORED;
  /** Slots without frames are known to be empty, but for those that something was stored in since. */
  let isErased = false;
  const unknown = new Set<number>();

  function playedFrames(slot: number): readonly Frame[] | null {
    const frames = groups.get(slot);
    if (frames === undefined && isErased && !unknown.has(slot)) return [];
    const own = percents.get(slot);
    const percent = own === undefined ? usualPercent : own;
    if (frames === undefined || percent === null) return null;
    if (percent === AS_STORED) return frames;
    const scaled = (durationMs: number): number => Math.round((durationMs * AS_STORED) / percent);
    return frames.map(({ durationMs, targets }) => ({ durationMs: scaled(durationMs), targets }));
  }

  return {
    store: (slot, frames) => void groups.set(slot, frames),
    clear(slot) {
      if (slot === undefined) {
        groups.clear();
        isErased = false;
        return;
      }
      groups.delete(slot);
      unknown.add(slot);
    },
    empty() {
      groups.clear();
      unknown.clear();
      isErased = true;
    },
    slots: () => [...groups.keys()].sort((a, b) => a - b),
    setSpeed(slot, percent) {
      if (slot !== null) percents.set(slot, percent);
      else {
        percents.clear();
        usualPercent = percent;
      }
    },
    forgetSpeeds() {
      if (percents.size > 0 || usualPercent !== AS_STORED) usualPercent = null;
      percents.clear();
    },
    playedFrames,
  };
}
