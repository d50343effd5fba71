// Targets and estimates of servos as they change: read once per frame, drawn or reported without React.

import type { Motions, ServoMotion } from '#shared/robot/state.ts';
import type { Device } from '../../robot/device.ts';
import { currentFrame, useFollow, HEARD_EACH_MS } from '../../ui/useEachFrame.ts';
import { useStores } from '../stores.ts';
import { useLayoutEffect, useState } from 'react';

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
