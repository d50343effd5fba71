// A servo's target as it changes by itself.

import { useLayoutEffect, useState } from 'react';
import { motionInFrame } from '../picture/motionInFrame.ts';
import type { Device } from '../../robot/device.ts';
import { useStores } from '../stores.ts';
import { HEARD_EACH_MS, useFollow } from '../../ui/useEachFrame.ts';

/** As of now; `motionInFrame` has it as of the frame that is drawn. */
export const targetOf = (device: Device, servo: number): number | null => device.motion(servo).target;

/** Past React's rounds: `say` is called no more often than it can be heard, and each time the component is drawn. */
export function useSaidTarget(servo: number, say: (target: number | null) => void): void {
  const { device } = useStores();
  useLayoutEffect(() => say(targetOf(device, servo)));
  useFollow({ read: () => motionInFrame(device, servo).target, draw: say, eachMs: HEARD_EACH_MS });
}

/** At most once a frame. */
export function useTarget(servo: number): number | null {
  const { device } = useStores();
  const [target, setTarget] = useState(() => targetOf(device, servo));
  useFollow({ read: () => motionInFrame(device, servo).target, draw: setTarget });
  return target;
}
