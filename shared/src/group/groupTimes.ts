// A group's frames as keys in time, worked out once for each state of them: tracks, ends, places by id.

import { motionLengthMs } from './blocks.ts';
import { easingOf, type ActionGroup, type Block, type GroupFrame } from './group.ts';
import { sameList } from './groupEdits.ts';
import {
  arePlacedAlike,
  frameEnds,
  keyIn,
  repositioned,
  tracksOf,
  type Key,
  type KeyRef,
  type Tracks,
} from './tracks.ts';

export interface GroupTimes extends Places {
  readonly frames: readonly GroupFrame[];
  readonly tracks: Tracks;
}

/** All of it is the very same as long as no key came, went or moved in time. */
interface Places {
  /** Those with a key, in ascending order. */
  readonly servos: readonly number[];
  /** When each frame is done. */
  readonly ends: readonly number[];
  /** Of all of it, its blocks too. */
  readonly lengthMs: number;
  /** A frame's place in the list by its id. */
  readonly places: ReadonlyMap<number, number>;
}

const known = new WeakMap<readonly GroupFrame[], GroupTimes>();
let latest: GroupTimes | undefined;

/** Blocks may last longer than the frames. */
const longer = new WeakMap<GroupTimes, { readonly blocks: readonly Block[]; readonly times: GroupTimes }>();

export function timesOf(group: Pick<ActionGroup, 'frames' | 'blocks'>): GroupTimes {
  const times = timesOfFrames(group);
  const { blocks } = group;
  if (blocks === undefined) return times;
  const before = longer.get(times);
  if (before?.blocks === blocks) return before.times;
  const made = { ...times, lengthMs: motionLengthMs(group) };
  longer.set(times, { blocks, times: made });
  return made;
}

function timesOfFrames({ frames }: Pick<ActionGroup, 'frames'>): GroupTimes {
  const before = known.get(frames);
  if (before !== undefined) return before;
  const times =
    latest !== undefined && arePlacedAlike(frames, latest.frames)
      ? { ...latest, frames, tracks: repositioned(frames, latest) ?? tracksOf({ frames }, latest.tracks) }
      : placedAnew(frames, latest);
  latest = times;
  known.set(frames, times);
  return times;
}

function placedAnew(frames: readonly GroupFrame[], before: GroupTimes | undefined): GroupTimes {
  const ends = frameEnds(frames);
  const tracks = tracksOf({ frames }, before?.tracks);
  return {
    ...{ frames, tracks, ends },
    servos: sameList(before?.servos ?? [], [...tracks.keys()]),
    lengthMs: ends.at(-1) ?? 0,
    places: placesOf(frames, before),
  };
}

/** The very same ones where the frames are the same by name, as they are after most edits. */
function placesOf(frames: readonly GroupFrame[], before: GroupTimes | undefined): GroupTimes['places'] {
  const isSame =
    before?.frames.length === frames.length &&
    before.frames.every(({ id }, index) => id === frames[index]?.id);
  return isSame ? before.places : new Map(frames.map(({ id }, index) => [id, index]));
}

/** When the frame is done; null where there is none. */
export function endOfFrame({ ends, places }: GroupTimes, frameId: number | null): number | null {
  return frameId === null ? null : (ends[places.get(frameId) ?? -1] ?? null);
}

export function allKeys({ tracks }: GroupTimes, servos: readonly number[]): readonly Key[] {
  return servos.flatMap((servo) => tracks.get(servo)?.keys ?? []);
}

export function keysOfFrame(
  { frames, ends, places }: GroupTimes,
  servos: readonly number[],
  frameId: number,
): readonly Key[] {
  const place = places.get(frameId) ?? -1;
  const [frame, atMs] = [frames[place], ends[place]];
  if (frame === undefined || atMs === undefined) return [];
  return frame.targets
    .filter(({ servo }) => servos.includes(servo))
    .map((target) => ({ ...target, frameId, atMs, easing: easingOf(target, frame) }));
}

export function keyOf(times: GroupTimes, ref: KeyRef): Key | undefined {
  const atMs = endOfFrame(times, ref.frameId);
  return atMs === null ? undefined : keyIn(times.tracks, ref, atMs);
}

/** The times of these keys, first and last; null where there are none. */
export function spanOf(keys: readonly Key[]): { readonly fromMs: number; readonly toMs: number } | null {
  let [fromMs, toMs] = [Infinity, -Infinity];
  for (const { atMs } of keys) {
    if (atMs < fromMs) fromMs = atMs;
    if (atMs > toMs) toMs = atMs;
  }
  return keys.length === 0 ? null : { fromMs, toMs };
}
