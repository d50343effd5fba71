// The pose at the playhead of the timeline, or of a blend of poses, for the picture of the body: neither commanded nor estimated, a
// preview. Drawn past React, because the playhead may be scrubbed. Moves nothing.

import { useRef } from 'react';
import { poseAtMs } from '#shared/actions/group/tracks.ts';
import { isSilent } from '../stores/servoView.ts';
import { servoViewOf, useStores, type Stores } from '../stores/stores.ts';
import { timesOf } from '../timeline/groupTimes.ts';
import { useEachFrame } from '../ui/useEachFrame.ts';
import type { Pose } from './pose.ts';

/** `draw` gets null where there is nothing to preview. */
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

/** What the preview depends on: the same again draws the same. */
function reasonsOf(stores: Stores): readonly unknown[] {
  const { showsPreview, playheadMs } = stores.timeline.getState();
  const { authoring } = stores.view.getState();
  const { family } = stores.device.store.getState();
  const { muted, solo } = servoViewOf(stores);
  const { targets } = stores.blend.store.getState();
  const group = stores.document.store.getState().present;
  return [group, showsPreview, playheadMs, authoring, family, muted, solo, targets];
}

function previewOf(stores: Stores): Pose | null {
  const { targets } = stores.blend.store.getState();
  if (targets !== null) return (servo) => targets.find((one) => one.servo === servo)?.position ?? null;
  const { showsPreview, playheadMs } = stores.timeline.getState();
  const group = stores.document.store.getState().present;
  const isShown = showsPreview && stores.view.getState().authoring === 'group';
  if (!isShown || group.unit !== stores.device.store.getState().family.unit) return null;
  const pose = poseAtMs(timesOf(group).tracks, playheadMs);
  const view = servoViewOf(stores);
  return pose.size === 0 ? null : (servo) => (isSilent(view, servo) ? null : (pose.get(servo) ?? null));
}
