// Keys that an edit means, taken out of their frames. Knows moments; not what becomes of the keys.

import type { ServoTarget } from '../../protocol/commands.ts';
import type { ActionGroup, GroupFrame } from './group.ts';
import { momentsOf, withTargets, type Moment } from './moments.ts';
import type { KeyRef } from './tracks.ts';

export interface LiftedKeys {
  readonly atMs: number;
  readonly frame: GroupFrame;
  readonly targets: readonly ServoTarget[];
}

/** The keys that are meant, frame by frame, and the moments without them. */
export function lifted(
  group: ActionGroup,
  refs: readonly KeyRef[],
): { readonly kept: readonly Moment[]; readonly keys: readonly LiftedKeys[] } {
  const meant = servosByFrame(refs);
  const keys: LiftedKeys[] = [];
  const kept = momentsOf(group).map((moment) => {
    const { atMs, frame } = moment;
    const servos = meant.get(frame.id);
    if (servos === undefined) return moment;
    const targets = frame.targets.filter(({ servo }) => servos.has(servo));
    if (targets.length === 0) return moment;
    keys.push({ atMs, frame, targets });
    return withTargets(
      moment,
      frame.targets.filter(({ servo }) => !servos.has(servo)),
    );
  });
  return { kept, keys };
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

/** Had keys before, and nothing is left to keep it for. */
export function isVacated({ frame }: Moment, { frames }: ActionGroup): boolean {
  const isBare = frame.targets.length === 0 && frame.note === '' && frame.colour === null;
  return isBare && frames.some(({ id, targets }) => id === frame.id && targets.length > 0);
}
