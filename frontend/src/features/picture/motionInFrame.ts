// The motion as of the frame that is being drawn: asked of the session once, however many needles show it.

import type { Motions, ServoMotion } from '#shared/robot/state.ts';
import type { Device } from '../../robot/device.ts';
import { currentFrame } from '../../ui/useEachFrame.ts';

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
  const asked = new Map<number, ServoMotion>();
  return (servo) => {
    const known = asked.get(servo) ?? motion(servo);
    asked.set(servo, known);
    return known;
  };
}
