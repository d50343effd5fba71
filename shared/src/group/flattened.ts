// A group without blocks, its motion as keys. Apart from the other edits of blocks, because the library needs it at the page's start.

import { blocksOf, motionTracks, servosOf } from './blocks.ts';
import type { ActionGroup, Block } from './group.ts';
import { sameList } from './groupEdits.ts';
import { momentsOf, newMoment, placed, withMoments, withTargets, type Moment } from './moments.ts';

export function withBlocks(group: ActionGroup, blocks: readonly Block[]): ActionGroup {
  const { blocks: _, ...rest } = group;
  const same = sameList(blocksOf(group), blocks);
  if (same === blocksOf(group)) return group;
  return same.length === 0 ? rest : { ...rest, blocks: same };
}

/** Blocks as keys, for formats that know none: the motion stays as it is. */
export function flattened(group: ActionGroup): ActionGroup {
  if (blocksOf(group).length === 0) return group;
  const covered = new Set(blocksOf(group).flatMap(servosOf));
  const tracks = motionTracks(group);
  const free = momentsOf(group).map((moment) =>
    withTargets(
      moment,
      moment.frame.targets.filter(({ servo }) => !covered.has(servo)),
    ),
  );
  const keys = [...covered].flatMap((servo) => tracks.get(servo)?.keys ?? []);
  const moments = keys.reduce<readonly Moment[]>(
    (all, { servo, atMs, position, easing }) =>
      placed(all, atMs, [{ servo, position, easing }], (own) => newMoment(atMs, own, { easing })),
    free,
  );
  return withBlocks(withMoments(group, moments), []);
}
