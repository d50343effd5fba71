// The preview for the picture of the body: the pose at the playhead of the timeline, or of a blend of poses. Drawn without React, because
// the playhead may be dragged. Moves nothing.

import { useRef } from 'react';
import { rescaled } from '#shared/profile/units.ts';
import { poseAtMs } from '#shared/group/tracks.ts';
import { knownFamily } from './groupBoard.ts';
import { isSilent } from './servoView.ts';
import { servoViewOf, useStores, type Stores } from './stores.ts';
import { timesOf } from '#shared/group/groupTimes.ts';
import { useEachFrame } from '../ui/useEachFrame.ts';
import type { Pose } from './picture/pose.ts';

/** Calls `draw` with each new preview, null for none. */
export function usePreview(draw: (pose: Pose | null) => void): void {
  const stores = useStores();
  const drawn = useRef<readonly unknown[]>([]);
  useEachFrame(() => {
    const now = reasonsOf(stores);
    if (now.every((reason, index) => reason === drawn.current[index])) return;
    drawn.current = now;
    draw(previewOf(stores));
  });
}

/** The values that the preview depends on. */
function reasonsOf(stores: Stores): readonly unknown[] {
  const { playheadMs } = stores.timeline.getState();
  const { family } = stores.device.store.getState();
  const { muted, solo } = servoViewOf(stores);
  const { targets } = stores.blend.store.getState();
  const group = stores.document.store.getState().present;
  return [group, isShown(stores), playheadMs, family, muted, solo, targets];
}

function isShown({ view, timeline, playback }: Stores): boolean {
  if (view.getState().authoring !== 'group') return false;
  return timeline.getState().showsPreview || playback.store.getState().phase === 'previewing';
}

function previewOf(stores: Stores): Pose | null {
  const { targets } = stores.blend.store.getState();
  if (targets !== null) return (servo) => targets.find((one) => one.servo === servo)?.position ?? null;
  const group = stores.document.store.getState().present;
  if (!isShown(stores)) return null;
  const { tracks, ends } = timesOf(group);
  // Before the end of the first frame the pose depends on where the robot is.
  const atMs = Math.max(stores.timeline.getState().playheadMs, ends[0] ?? 0);
  const pose = poseAtMs(tracks, atMs);
  const view = servoViewOf(stores);
  const { unit } = knownFamily(stores.device.store.getState().family, stores.robots.current().robot);
  return pose.size === 0
    ? null
    : (servo) => {
        const position = isSilent(view, servo) ? undefined : pose.get(servo);
        return position === undefined ? null : rescaled(position, group.unit, unit);
      };
}
