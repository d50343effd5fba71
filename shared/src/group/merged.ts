// Lifted keys put down at new instants among the moments that stay. Knows moments; not why the keys move.

import type { ServoTarget } from '../codec/commands.ts';
import { sortedTargets, type GroupFrame } from './group.ts';
import type { Lifted } from './lifted.ts';
import { newMoment, type Moment } from './moments.ts';

export interface Merged {
  /** The moments that stay, with the keys that came to them. */
  readonly staying: readonly Moment[];
  /** Those of the keys that came to no moment, or met another key of their servo there. */
  readonly added: readonly Moment[];
}

/** A frame that loses all its keys goes along with them. No key is lost: one that meets another of its servo stands at the same instant. */
export function merged(before: readonly Moment[], keys: Lifted['keys'], vacated: Lifted['vacated']): Merged {
  const moments = [...before];
  const placeAt = new Map(before.map(({ atMs }, index) => [atMs, index]));
  for (const { atMs, frame, targets } of keys) {
    const place = placeAt.get(atMs) ?? -1;
    const there = moments[place];
    if (there === undefined || isInOne(there.frame.targets, targets)) {
      placeAt.set(atMs, moments.length);
      moments.push(movedFrame(frame, targets, atMs, vacated.has(frame.id)));
    } else {
      const all = sortedTargets([...there.frame.targets, ...targets]);
      moments[place] = { ...there, frame: { ...there.frame, targets: all } };
    }
  }
  return { staying: moments.slice(0, before.length), added: moments.slice(before.length) };
}

function isInOne(some: readonly ServoTarget[], others: readonly ServoTarget[]): boolean {
  const servos = new Set(some.map(({ servo }) => servo));
  return others.some(({ servo }) => servos.has(servo));
}

const movedFrame = (
  frame: GroupFrame,
  targets: readonly ServoTarget[],
  atMs: number,
  isVacated: boolean,
): Moment =>
  isVacated ? { atMs, frame: { ...frame, targets } } : newMoment(atMs, targets, { easing: frame.easing });
