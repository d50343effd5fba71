// Blocks: motion under a name on a track above the keys, repeated, faster or slower. While one lasts its servos do what it says and not
// what their own keys say. What compiles, plays or draws a motion takes the tracks from here. Changes no group.

import { partOf, type Easing } from './curves.ts';
import { easingOf, totalDurationMs, type ActionGroup, type Block, type GroupFrame } from './group.ts';
import { keysUntil, positionAt, tracksOf, type Key, type Track, type Tracks } from './tracks.ts';

const NO_BLOCKS: readonly Block[] = [];

export const blocksOf = ({ blocks = NO_BLOCKS }: Pick<ActionGroup, 'blocks'>): readonly Block[] => blocks;

/** Of one pass, as fast as it was recorded. */
const motionMs = ({ moments }: Block): number => moments.at(-1)?.atMs ?? 0;

/** Since the first key of the first pass. */
const passMs = (block: Block, pass: number, atMs: number): number =>
  Math.round(((pass * (motionMs(block) + block.gapMs) + atMs) * 100) / block.speedPercent);

/** With the ways into it and out of it. */
export const blockMs = (block: Block): number =>
  block.blendInMs + passMs(block, block.times - 1, motionMs(block)) + block.blendOutMs;

export const endOfBlock = (block: Block): number => block.startMs + blockMs(block);

const servosIn = new WeakMap<Block['moments'], readonly number[]>();

/** In ascending order; found once, because each row that is drawn wants them. */
export function servosOf({ moments }: Pick<Block, 'moments'>): readonly number[] {
  const before = servosIn.get(moments);
  if (before !== undefined) return before;
  const servos = new Set(moments.flatMap(({ targets }) => targets.map(({ servo }) => servo)));
  const sorted = [...servos].sort((one, other) => one - other);
  servosIn.set(moments, sorted);
  return sorted;
}

/** The one that says what the servo does then; undefined: its own keys do. */
export function blockOver(
  group: Pick<ActionGroup, 'blocks'>,
  servo: number,
  atMs: number,
): Block | undefined {
  return blocksOf(group).find(
    (block) => block.startMs <= atMs && atMs <= endOfBlock(block) && servosOf(block).includes(servo),
  );
}

/** Keys of a block have no frame: its number is below zero there. */
export const blockIdOf = (frameId: number): number | null => (frameId < 0 ? -frameId : null);

/** Of the frames and of the blocks, whichever last longer. */
export const motionLengthMs = (group: Pick<ActionGroup, 'frames' | 'blocks'>): number =>
  blocksOf(group).reduce((ms, block) => Math.max(ms, endOfBlock(block)), totalDurationMs(group.frames));

const known = new WeakMap<
  readonly GroupFrame[],
  { readonly blocks: readonly Block[]; readonly tracks: Tracks }
>();

/** What the servos do. Where two blocks have the same servo, the one that begins later counts. `own`: of the keys alone, where known. */
export function motionTracks(group: Pick<ActionGroup, 'frames' | 'blocks'>, own = tracksOf(group)): Tracks {
  const blocks = blocksOf(group);
  if (blocks.length === 0) return own;
  const before = known.get(group.frames);
  if (before?.blocks === blocks) return before.tracks;
  const tracks = blocks
    .toSorted((one, other) => one.startMs - other.startMs)
    .reduce((sum, block) => laid(sum, block), own);
  known.set(group.frames, { blocks, tracks });
  return tracks;
}

function laid(tracks: Tracks, block: Block): Tracks {
  const all = new Map(tracks);
  for (const servo of servosOf(block)) {
    const track = tracks.get(servo);
    const keys = keysOf(block, servo);
    all.set(servo, { servo, keys: track === undefined ? keys : joined(track, keys, block) });
  }
  return new Map([...all].sort(([one], [other]) => one - other));
}

/** Pass by pass. */
function keysOf(block: Block, servo: number): readonly Key[] {
  const begunMs = block.startMs + block.blendInMs;
  return Array.from({ length: block.times }, (_, pass) => pass).flatMap((pass) =>
    block.moments.flatMap((moment) => {
      const target = moment.targets.find((one) => one.servo === servo);
      // Behind a pass that ends where it begins it stands there already.
      if (target === undefined || (pass > 0 && block.gapMs === 0 && moment.atMs === 0)) return [];
      const atMs = begunMs + passMs(block, pass, moment.atMs);
      return { frameId: -block.id, servo, atMs, position: target.position, easing: easingOf(target, moment) };
    }),
  );
}

/** The servo's own keys before and behind the block, with the block's between them. */
function joined(track: Track, between: readonly Key[], block: Block): readonly Key[] {
  const { keys, servo } = track;
  const [fromMs, toMs] = [block.startMs, endOfBlock(block)];
  const before = keys.filter(({ atMs }) => atMs < fromMs);
  const behind = keys.filter(({ atMs }) => atMs > toMs);
  const end = (atMs: number, easing: Easing): readonly Key[] => {
    const position = positionAt(track, atMs);
    return position === null
      ? []
      : [{ frameId: -block.id, servo, atMs, position: Math.round(position), easing }];
  };
  const entry = block.blendInMs > 0 ? end(fromMs, cut(track, fromMs, 'before')) : [];
  const exit = block.blendOutMs > 0 ? end(toMs, 'inOut') : [];
  const [first, ...others] = between;
  const [next, ...rest] = behind;
  return [
    ...before,
    ...entry,
    // From where it was it comes gently.
    ...(first === undefined ? [] : [entry.length > 0 ? { ...first, easing: 'inOut' as const } : first]),
    ...others,
    ...exit,
    ...(next === undefined ? [] : [exit.length > 0 ? { ...next, easing: cut(track, toMs, 'behind') } : next]),
    ...rest,
  ];
}

/** How the way that is under way at that instant is gone before or behind it. */
function cut({ keys }: Track, atMs: number, side: 'before' | 'behind'): Easing {
  const reached = keysUntil(keys, atMs);
  const [from, to] = [keys[reached - 1], keys[reached]];
  return from === undefined || to === undefined
    ? 'linear'
    : partOf(to.easing, (atMs - from.atMs) / (to.atMs - from.atMs), side);
}
