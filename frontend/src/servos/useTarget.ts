// A servo's target as it changes by itself.

import { useLayoutEffect, useState } from 'react';
import { motionInFrame } from '../body/motionInFrame.ts';
import type { Device } from '../stores/device.ts';
import { useStores } from '../stores/stores.ts';
import { useFollow } from '../ui/useFollow.ts';

/** No more often can it be read. */
export const READ_EACH_MS = 100;

/** As of now; `motionInFrame` has it as of the frame that is drawn. */
export const targetOf = (device: Device, servo: number): number | null => device.motion(servo).target;

/** Past React's rounds: `show` is called no more often than it can be read, and each time the component is drawn. */
export function useReadableTarget(servo: number, show: (target: number | null) => void): void {
  const { device } = useStores();
  useLayoutEffect(() => show(targetOf(device, servo)));
  useFollow({ read: () => motionInFrame(device, servo).target, draw: show, eachMs: READ_EACH_MS });
}

/** The target, at most once a frame, and a function that takes it over at once. */
export function useTarget(servo: number, eachMs = 0): readonly [number | null, () => void] {
  const { device } = useStores();
  const [target, setTarget] = useState(() => targetOf(device, servo));
  useFollow({ read: () => motionInFrame(device, servo).target, draw: setTarget, eachMs });
  return [target, () => setTarget(targetOf(device, servo))];
}
