// Edits of blocks, pure as all others: the very same group where nothing changes. What a block does is blocks.ts.

import { sortedTargets } from '../codec/commands.ts';
import { blocksOf, endOfBlock, servosOf } from './blocks.ts';
import {
  FASTEST_PERCENT,
  MAX_FRAMES,
  MOST_TIMES,
  SLOWEST_PERCENT,
  type ActionGroup,
  type Block,
  type BlockMoment,
} from './group.ts';
import { flattened, withBlocks } from './flattened.ts';
import { changed } from './groupEdits.ts';
import { lifted } from './keyRanges.ts';
import { carried, momentsOf, withMoments } from './moments.ts';
import type { TimeRange } from './timeEdits.ts';
import type { KeyRef } from './tracks.ts';

/**
 * The keys of these servos from the first to the last of these keys, under a name. The motion stays as it is; null where there is none to
 * take.
 */
export function makeBlock(group: ActionGroup, refs: readonly KeyRef[], name: string): ActionGroup | null {
  const servos = new Set(refs.map(({ servo }) => servo));
  const chosen = lifted(group, refs).keys;
  const [fromMs, toMs] = [chosen[0]?.atMs ?? 0, chosen.at(-1)?.atMs ?? 0];
  if (chosen.length === 0) return null;
  const all = momentsOf(group)
    .filter(({ atMs }) => atMs >= fromMs && atMs <= toMs)
    .flatMap(({ frame: { id: frameId, targets } }) =>
      targets.filter(({ servo }) => servos.has(servo)).map(({ servo }) => ({ frameId, servo })),
    );
  const { remaining, keys, vacated } = lifted(group, all);
  const moments = keys.map(({ atMs, frame: { easing }, targets }) => ({
    atMs: atMs - fromMs,
    easing,
    targets,
  }));
  const block: Block = {
    ...{ id: group.nextId, name, startMs: fromMs, times: 1, speedPercent: 100, blendInMs: 0, blendOutMs: 0 },
    ...{
      gapMs: endsWhereItBegins(moments) ? 0 : (keys[0]?.frame.durationMs ?? 0),
      moments: gathered(moments),
    },
  };
  const left = withMoments(
    group,
    remaining.filter(({ frame }) => !vacated.has(frame.id)),
  );
  return withBlocks({ ...left, nextId: Math.max(left.nextId, block.id + 1) }, [...blocksOf(group), block]);
}

function endsWhereItBegins(moments: readonly BlockMoment[]): boolean {
  const [first, ...others] = moments;
  const last = new Map(
    others.flatMap(({ targets }) => targets.map(({ servo, position }) => [servo, position])),
  );
  return (
    last.size > 0 && first?.targets.every(({ servo, position }) => last.get(servo) === position) === true
  );
}

/** Moments at the same instant are one; of two keys of a servo the later one counts, as it does where it moves. */
function gathered(moments: readonly BlockMoment[]): readonly BlockMoment[] {
  return moments.reduce<readonly BlockMoment[]>((all, one) => {
    const last = all.at(-1);
    if (last?.atMs !== one.atMs) return [...all, one];
    const arriving = carried(one.targets, one.easing, last.easing);
    return all.with(-1, { ...last, targets: sortedTargets([...last.targets, ...arriving]) });
  }, []);
}

/** What of a block may be set. */
export type BlockChange = Partial<
  Pick<Block, 'name' | 'startMs' | 'times' | 'speedPercent' | 'blendInMs' | 'blendOutMs'>
>;

export function setBlock(group: ActionGroup, id: number, change: BlockChange): ActionGroup {
  return withBlocks(
    group,
    blocksOf(group).map((block) => (block.id === id ? changed<Block>(block, within(block, change)) : block)),
  );
}

/** As far as a document can hold it. */
function within({ moments }: Block, change: BlockChange): BlockChange {
  const bounded = (value: number, least: number, most: number): number =>
    Math.min(most, Math.max(least, Math.round(value)));
  const mostTimes = Math.min(MOST_TIMES, Math.floor(MAX_FRAMES / moments.length));
  const { startMs, times, speedPercent, blendInMs, blendOutMs, ...rest } = change;
  return {
    ...rest,
    ...(startMs !== undefined && { startMs: bounded(startMs, 0, MAX_START_MS) }),
    ...(times !== undefined && { times: bounded(times, 1, mostTimes) }),
    ...(speedPercent !== undefined && {
      speedPercent: bounded(speedPercent, SLOWEST_PERCENT, FASTEST_PERCENT),
    }),
    ...(blendInMs !== undefined && { blendInMs: bounded(blendInMs, 0, 0xffff) }),
    ...(blendOutMs !== undefined && { blendOutMs: bounded(blendOutMs, 0, 0xffff) }),
  };
}

/** An hour: far behind every motion, and a drag gets nowhere near it. */
const MAX_START_MS = 3_600_000;

export const deleteBlock = (group: ActionGroup, id: number): ActionGroup =>
  withBlocks(
    group,
    blocksOf(group).filter((block) => block.id !== id),
  );

/** Right behind the block, once more. */
export function duplicateBlock(group: ActionGroup, id: number): ActionGroup {
  const block = blocksOf(group).find((one) => one.id === id);
  if (block === undefined) return group;
  const copy = { ...block, id: group.nextId, startMs: Math.min(MAX_START_MS, endOfBlock(block)) };
  return withBlocks({ ...group, nextId: group.nextId + 1 }, [...blocksOf(group), copy]);
}

/** Its keys in the place of those that it covers. */
export function unpackBlock(group: ActionGroup, id: number): ActionGroup {
  const block = blocksOf(group).find((one) => one.id === id);
  if (block === undefined) return group;
  const others = blocksOf(group).filter((one) => one !== block);
  return withBlocks(flattened(withBlocks(group, [block])), others);
}

/** Those that have one of the servos within the time become keys, so that keys put there count. */
export function unpackedWithin(
  group: ActionGroup,
  servos: ReadonlySet<number>,
  { fromMs, toMs }: TimeRange,
): ActionGroup {
  return blocksOf(group)
    .filter(
      (block) =>
        block.startMs <= toMs &&
        endOfBlock(block) >= fromMs &&
        servosOf(block).some((servo) => servos.has(servo)),
    )
    .reduce((sum, { id }) => unpackBlock(sum, id), group);
}

/** Blocks that overlap stand below one another: the level of each by its id, from 0 on. */
export function levelsOf(blocks: readonly Block[]): ReadonlyMap<number, number> {
  const ends: number[] = [];
  const levels = new Map<number, number>();
  for (const block of blocks.toSorted((one, other) => one.startMs - other.startMs)) {
    const free = ends.findIndex((endMs) => endMs <= block.startMs);
    const level = free === -1 ? ends.length : free;
    ends[level] = endOfBlock(block);
    levels.set(block.id, level);
  }
  return levels;
}
