// Which frames are selected as a whole, with every key of theirs in a row that is shown, and the rests between them: what the strip
// marks, and what is done to several frames is done to. The list is pure, and kept as long as it says the same.

import { sameList } from '#shared/actions/group/groupEdits.ts';
import type { Key } from '#shared/actions/group/tracks.ts';
import type { KeySet } from '../stores/timeline/keySet.ts';
import { useDocument, useTimeline } from '../stores/stores.ts';
import { selectedKeys, timesOf, type GroupTimes } from './groupTimes.ts';
import { useRows } from './useRows.ts';

/** In the order of time. A frame without a key to select goes with the frames on both sides of it. */
export function wholeFrames(
  times: GroupTimes,
  selected: KeySet,
  shownServos: ReadonlySet<number>,
): readonly number[] {
  const { frames, places } = times;
  const counts = new Map<number, number>();
  for (const { frameId, servo } of selectedKeys(times, selected)) {
    const place = shownServos.has(servo) ? places.get(frameId) : undefined;
    if (place !== undefined) counts.set(place, (counts.get(place) ?? 0) + 1);
  }
  const keysAt = (place: number): number =>
    frames[place]?.targets.filter(({ servo }) => shownServos.has(servo)).length ?? 0;
  const whole = [...counts]
    .filter(([place, count]) => count === keysAt(place))
    .map(([place]) => place)
    .toSorted((one, other) => one - other);
  return whole.flatMap((place, index) => {
    const before = whole[index - 1] ?? place;
    const between = frames.slice(before + 1, place);
    const isRest = between.every((_, offset) => keysAt(before + 1 + offset) === 0);
    return [...(isRest ? between : []), frames[place]].flatMap((frame) => (frame ? [frame.id] : []));
  });
}

interface Whole {
  readonly shown: readonly number[];
  readonly ids: readonly number[];
}

/** By the selected keys, of which there is one list for each selection in each state of the group. */
const known = new WeakMap<readonly Key[], Whole>();
let latest: readonly number[] = [];

/** The very same list as before where it says the same: an edit that leaves them the same has nothing drawn again. */
function wholeNow(times: GroupTimes, selected: KeySet, shown: readonly number[]): readonly number[] {
  const keys = selectedKeys(times, selected);
  const before = known.get(keys);
  if (before?.shown === shown) return before.ids;
  latest = sameList(before?.ids ?? latest, wholeFrames(times, selected, new Set(shown)));
  known.set(keys, { shown, ids: latest });
  return latest;
}

export function useWholeFrames(): readonly number[] {
  const selected = useTimeline((state) => state.selected);
  const shown = useRows().find(({ kind }) => kind === 'all')?.servos ?? NO_SERVOS;
  return useDocument(({ present }) => wholeNow(timesOf(present), selected, shown));
}

const NO_SERVOS: readonly number[] = [];
