// What Run would run, and how often, as it was chosen on this screen; and such a run.

import type { Device } from '../../robot/device.ts';
import type { View } from '../view.ts';
import { useDevice, useSlot, useView } from '../stores.ts';

export interface RunSettings {
  readonly slot: number;
  /** 0: until stopped. */
  readonly times: number;
  readonly untilStopped: boolean;
  /** Some boards take no number of times for "without end". */
  readonly canRepeat: boolean;
}

export function useRunSettings(): RunSettings {
  const slot = useSlot();
  const canRepeat = useDevice((state) => state.family.zeroTimes === 'endless');
  const untilStopped = useView((state) => state.untilStopped) && canRepeat;
  const times = useView((state) => state.times);
  return { slot, canRepeat, untilStopped, times: untilStopped ? 0 : times };
}

// A run as it was chosen beside its button: bound to this page, or, for this one time, to go on without it.

interface Parts {
  readonly device: Device;
  readonly view: View;
}

/** `settled` as for `device.run`. */
export function runAsChosen(
  { device, view }: Parts,
  slot: number,
  times: number,
  settled: (isTaken: boolean) => void = () => undefined,
): void {
  const { keepsRunning, keepRunningMinutes } = view.getState();
  view.setState({ keepsRunning: false });
  device.run(slot, times, (isTaken) => {
    if (isTaken && keepsRunning) device.keepRunning(keepRunningMinutes * 60_000);
    settled(isTaken);
  });
}
