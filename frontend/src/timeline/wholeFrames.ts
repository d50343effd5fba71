// Which frames are selected as a whole, with every key of theirs in a row that is shown, and the rests between them: what the strip
// marks, and what is done to several frames is done to. Pure but for the hook at the end.

import { useMemo } from 'react';
import { refsOf, type KeySet } from '../stores/keySet.ts';
import { useDocument, useTimeline } from '../stores/stores.ts';
import { timesOf, type GroupTimes } from './groupTimes.ts';
import { useRows } from './useRows.ts';

/** In the order of time. A frame without a key to select goes with the frames on both sides of it. */
export function wholeFrames(
  { frames, places }: Pick<GroupTimes, 'frames' | 'places'>,
  selected: KeySet,
  shownServos: ReadonlySet<number>,
): readonly number[] {
  const counts = new Map<number, number>();
  for (const { frameId, servo } of refsOf(selected)) {
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

/** As text in between: an edit that leaves them the same has nothing drawn again. */
export function useWholeFrames(): readonly number[] {
  const selected = useTimeline((state) => state.selected);
  const shown = useRows().find(({ kind }) => kind === 'all')?.servos;
  const ids = useDocument(({ present }) => wholeFrames(timesOf(present), selected, new Set(shown)).join());
  return useMemo(() => (ids === '' ? [] : ids.split(',').map(Number)), [ids]);
}
