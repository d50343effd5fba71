// Drawing several servos as one picture, and the poses of the frames before and after the playhead. Apart from motion.ts, which is in the
// first load.

import type { ServoMotion } from '#shared/robot/state.ts';
import { useFollow, useEachFrame } from '../../ui/useEachFrame.ts';
import { useStores, type Stores } from '../stores.ts';
import { motionInFrame, poseOfGroup, reasonsOf } from './motion.ts';
import { useRef } from 'react';
import { timesOf } from '#shared/group/groupTimes.ts';
import type { Pose } from './pose.ts';

/** Calls `draw` in each frame in which one of the servos moved. A robot at rest costs nothing. */
export function useMotions(servos: readonly number[], draw: () => void): void {
  const { device } = useStores();
  useFollow({
    read: () => servos.map((servo) => motionInFrame(device, servo)),
    isSame: sameMotions,
    draw,
  });
}

function sameMotions(some: readonly ServoMotion[], others: readonly ServoMotion[]): boolean {
  return (
    some.length === others.length &&
    some.every((one, index) => {
      const other = others[index];
      return other !== undefined && sameMotion(one, other);
    })
  );
}

function sameMotion(one: ServoMotion, other: ServoMotion): boolean {
  return one.target === other.target && one.estimated === other.estimated;
}

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
