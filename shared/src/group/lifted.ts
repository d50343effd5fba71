// Keys that an edit means, taken out of their frames. Knows moments; not what becomes of the keys.

import type { ServoTarget } from '../codec/commands.ts';
import type { ActionGroup, GroupFrame } from './group.ts';
import { momentsOf, withTargets, type Moment } from './moments.ts';
import type { TimeRange } from './timeEdits.ts';
import type { KeyRef } from './tracks.ts';

export interface LiftedKeys {
  readonly atMs: number;
  readonly frame: GroupFrame;
  readonly targets: readonly ServoTarget[];
}

export interface Lifted {
  /** Every moment, without these keys. */
  readonly kept: readonly Moment[];
  readonly keys: readonly LiftedKeys[];
  /** The frames that had no other key and carry no note or colour: nothing is left to keep them for. */
  readonly vacated: ReadonlySet<number>;
}

/** The keys that are meant, frame by frame, and what is left without them. */
export function lifted(group: ActionGroup, refs: readonly KeyRef[]): Lifted {
  const meant = servosByFrame(refs);
  const keys: LiftedKeys[] = [];
  const vacated = new Set<number>();
  const kept = momentsOf(group).map((moment) => {
    const { atMs, frame } = moment;
    const servos = meant.get(frame.id);
    if (servos === undefined) return moment;
    const targets = frame.targets.filter(({ servo }) => servos.has(servo));
    if (targets.length === 0) return moment;
    keys.push({ atMs, frame, targets });
    const left = frame.targets.filter(({ servo }) => !servos.has(servo));
    if (left.length === 0 && frame.note === '' && frame.colour === null) vacated.add(frame.id);
    return withTargets(moment, left);
  });
  return { kept, keys, vacated };
}

/** Whether keys are left in the range, its ends included. */
export function hasOthers(kept: Lifted['kept'], { fromMs, toMs }: TimeRange): boolean {
  return kept.some(({ atMs, frame }) => atMs >= fromMs && atMs <= toMs && frame.targets.length > 0);
}

export function servosByFrame(refs: readonly KeyRef[]): ReadonlyMap<number, ReadonlySet<number>> {
  const servos = new Map<number, Set<number>>();
  for (const { frameId, servo } of refs) {
    const own = servos.get(frameId);
    if (own === undefined) servos.set(frameId, new Set([servo]));
    else own.add(servo);
  }
  return servos;
}
