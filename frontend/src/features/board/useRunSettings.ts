// What Run would run, and how often, as it was chosen on this screen.

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
