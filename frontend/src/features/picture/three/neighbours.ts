// The frames before and after the playhead as poses, anew whenever what they depend on changes. Draws nothing.

import { useRef } from 'react';
import { timesOf } from '#shared/group/groupTimes.ts';
import { useEachFrame } from '../../../ui/useEachFrame.ts';
import { type Stores, useStores } from '../../stores.ts';
import { poseOfGroup, reasonsOf } from '../motion.ts';
import type { Pose } from '../pose.ts';

/** The frames on both sides of the playhead. */
export interface Neighbours {
  readonly before: Pose | null;
  readonly after: Pose | null;
}

export const NO_NEIGHBOURS: Neighbours = { before: null, after: null };

/** Calls `draw` with the poses before and after the playhead while `isOn`, and once with none afterwards. `of`: what they are drawn on. */
export function useNeighbours(isOn: boolean, of: unknown, draw: (poses: Neighbours) => void): void {
  const stores = useStores();
  const drawn = useRef<readonly unknown[]>([]);
  useEachFrame(() => {
    const now = isOn ? [of, ...reasonsOf(stores)] : [];
    if (now.length === drawn.current.length && now.every((reason, index) => reason === drawn.current[index]))
      return;
    drawn.current = now;
    draw(isOn ? neighboursOf(stores) : NO_NEIGHBOURS);
  });
}

function neighboursOf(stores: Stores): Neighbours {
  const { playheadMs } = stores.timeline.getState();
  const { ends } = timesOf(stores.document.store.getState().present);
  const [before, after] = [
    ends.findLast((endMs) => endMs < playheadMs),
    ends.find((endMs) => endMs > playheadMs),
  ];
  const poseAt = (atMs: number | undefined): Pose | null =>
    atMs === undefined ? null : poseOfGroup(stores, atMs);
  return { before: poseAt(before), after: poseAt(after) };
}
