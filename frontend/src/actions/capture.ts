// Puts the pose that the robot was asked for into the group, as a frame beside another one. Moves nothing.

import { insertFrame } from '#shared/actions/group/groupEdits.ts';
import type { Stores } from '../stores/stores.ts';
import { words } from '../words/words.ts';
import { commandedPose } from './pose.ts';

const USUAL_FRAME_MS = 1000;

/** As long as the frame it stands behind. Without a selected frame it comes to the end. */
export function captureFrame(
  { device, document, view }: Pick<Stores, 'device' | 'document' | 'view'>,
  side: 'before' | 'after',
): void {
  const { targets, family } = device.store.getState();
  const { nextId, frames } = document.store.getState().present;
  const selected = frames.findIndex(({ id }) => id === view.getState().selectedFrame);
  const index = selected < 0 ? frames.length : selected + (side === 'after' ? 1 : 0);
  const durationMs = (frames[index - 1] ?? frames[0])?.durationMs ?? USUAL_FRAME_MS;
  document.edit(
    () => words.actions.steps.capture,
    (group) => insertFrame(group, index, { durationMs, targets: commandedPose(targets) }, family.unit),
  );
  view.setState({ selectedFrame: nextId });
}
