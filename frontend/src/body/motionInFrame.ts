// A servo's motion as of the frame that is being drawn: asked of the session once, however many needles show it.

import type { ServoMotion } from '#shared/session/state.ts';
import type { Device } from '../stores/device.ts';

interface Seen {
  readonly atMs: CSSNumberish | null;
  readonly motions: Map<number, ServoMotion>;
}

const seen = new WeakMap<Device, Seen>();

export function motionInFrame(device: Device, servo: number): ServoMotion {
  const motions = motionsOf(device);
  const known = motions.get(servo);
  if (known !== undefined) return known;
  const motion = device.motion(servo);
  motions.set(servo, motion);
  return motion;
}

/** The document's time stands still within a frame. */
function motionsOf(device: Device): Map<number, ServoMotion> {
  const atMs = document.timeline.currentTime;
  const before = seen.get(device);
  if (before?.atMs === atMs) return before.motions;
  const motions = new Map<number, ServoMotion>();
  seen.set(device, { atMs, motions });
  return motions;
}
