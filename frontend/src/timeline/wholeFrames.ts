// Which frames are selected as a whole, with every key of theirs in a row that is shown: what the strip marks, and what is done to
// several frames is done to. Pure but for the hook at the end.

import { useMemo } from 'react';
import { refsOf, type KeySet } from '../stores/keySet.ts';
import { useDocument, useTimeline } from '../stores/stores.ts';
import { timesOf, type GroupTimes } from './groupTimes.ts';
import { useRows } from './useRows.ts';

/** In the order of time. */
export function wholeFrames(
  { frames, places }: Pick<GroupTimes, 'frames' | 'places'>,
  selected: KeySet,
  shownServos: ReadonlySet<number>,
): readonly number[] {
  const counts = new Map<number, number>();
  for (const { frameId, servo } of refsOf(selected))
    if (shownServos.has(servo)) counts.set(frameId, (counts.get(frameId) ?? 0) + 1);
  const isWhole = ([id, count]: [number, number]): boolean => {
    const targets = frames[places.get(id) ?? -1]?.targets ?? [];
    return count === targets.filter(({ servo }) => shownServos.has(servo)).length;
  };
  return [...counts]
    .filter(isWhole)
    .map(([id]) => id)
    .toSorted((one, other) => (places.get(one) ?? 0) - (places.get(other) ?? 0));
}

/** As text in between: an edit that leaves them the same has nothing drawn again. */
export function useWholeFrames(): readonly number[] {
  const selected = useTimeline((state) => state.selected);
  const shown = useRows().find(({ kind }) => kind === 'all')?.servos;
  const ids = useDocument(({ present }) => wholeFrames(timesOf(present), selected, new Set(shown)).join());
  return useMemo(() => (ids === '' ? [] : ids.split(',').map(Number)), [ids]);
}
