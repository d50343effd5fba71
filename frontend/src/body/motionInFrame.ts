// A servo's motion as of the frame that is being drawn: asked of the session once, however many needles show it.

import type { ServoMotion } from '#shared/session/state.ts';
import type { Device } from '../stores/device/device.ts';
import { frameAtHand } from '../ui/useEachFrame.ts';

interface Seen {
  readonly frame: number;
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

function motionsOf(device: Device): Map<number, ServoMotion> {
  const frame = frameAtHand();
  const before = seen.get(device);
  if (before?.frame === frame) return before.motions;
  const motions = new Map<number, ServoMotion>();
  seen.set(device, { frame, motions });
  return motions;
}
