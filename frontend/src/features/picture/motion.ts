// What the picture of the robot shows as it changes, without React: targets and estimates of servos, read once per frame, and the preview:
// the pose at the playhead of the timeline, or of a blend of poses. Moves nothing.

import { motionTracks } from '#shared/group/blocks.ts';
import type { Motions, ServoMotion } from '#shared/robot/state.ts';
import type { Device } from '../../robot/device.ts';
import { currentFrame, useFollow, HEARD_EACH_MS, useEachFrame } from '../../ui/useEachFrame.ts';
import { useStores, servoViewOf, type Stores } from '../stores.ts';
import { useLayoutEffect, useState, useRef } from 'react';
import { rescaled } from '#shared/profile/units.ts';
import { poseAtMs } from '#shared/group/tracks.ts';
import { knownFamily } from '../groupDocument.ts';
import { isSilent } from '../servoView.ts';
import { timesOf } from '#shared/group/groupTimes.ts';
import type { Pose } from './pose.ts';

interface Seen {
  readonly frame: number;
  readonly motion: Motions;
}

const seen = new WeakMap<Device, Seen>();

export const motionInFrame = (device: Device, servo: number): ServoMotion => motionsInFrame(device)(servo);

export function motionsInFrame(device: Device): Motions {
  const frame = currentFrame();
  const before = seen.get(device);
  if (before?.frame === frame) return before.motion;
  const motion = eachOnce(device.motions());
  seen.set(device, { frame, motion });
  return motion;
}

function eachOnce(motion: Motions): Motions {
  const requested = new Map<number, ServoMotion>();
  return (servo) => {
    const known = requested.get(servo) ?? motion(servo);
    requested.set(servo, known);
    return known;
  };
}

/** The target now; `motionInFrame` has it at the time of the frame. */
export const targetOf = (device: Device, servo: number): number | null => device.motion(servo).target;

/** Calls `say` with the target, no more often than a screen reader can follow, and after each render. */
export function useSaidTarget(servo: number, say: (target: number | null) => void): void {
  const { device } = useStores();
  useLayoutEffect(() => say(targetOf(device, servo)));
  useFollow({ read: () => motionInFrame(device, servo).target, draw: say, eachMs: HEARD_EACH_MS });
}

/** Renders with each new target, at most once a frame. */
export function useTarget(servo: number): number | null {
  const { device } = useStores();
  const [target, setTarget] = useState(() => targetOf(device, servo));
  useFollow({ read: () => motionInFrame(device, servo).target, draw: setTarget });
  return target;
}

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
export function reasonsOf(stores: Stores): readonly unknown[] {
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
  if (!isShown(stores)) return null;
  const { ends } = timesOf(stores.document.store.getState().present);
  // Before the end of the first frame the pose depends on where the robot is.
  return poseOfGroup(stores, Math.max(stores.timeline.getState().playheadMs, ends[0] ?? 0));
}

/** Of the group that is open, in the unit of the board; null where it has no frames. */
export function poseOfGroup(stores: Stores, atMs: number): Pose | null {
  const group = stores.document.store.getState().present;
  const pose = poseAtMs(motionTracks(group, timesOf(group).tracks), atMs);
  const view = servoViewOf(stores);
  const { unit } = knownFamily(stores.device.store.getState().family, stores.robots.current().robot);
  return pose.size === 0
    ? null
    : (servo) => {
        const position = isSilent(view, servo) ? undefined : pose.get(servo);
        return position === undefined ? null : rescaled(position, group.unit, unit);
      };
}
