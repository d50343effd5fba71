// STOP of the robot of this page, present while a link exists.

import { useDevice, useStores, type Stores } from '../stores.ts';
import type { Action } from '../../ui/action.ts';
import { STOP_KEYS, StopKey } from '../../ui/StopKey.tsx';
import { words } from '../../i18n/words.ts';

/** Its key is the only one that works everywhere; see StopKey.tsx. */
export const STOP: Action<Pick<Stores, 'device'>> = {
  ...{ id: 'stop', icon: 'end', keys: STOP_KEYS },
  label: () => words.stop.button,
  enabled: ({ device }) => device.store.getState().way !== null || words.servos.blocked.closed,
  run: ({ device }) => device.halt(),
};

export function StopButton() {
  const { device } = useStores();
  const exists = useDevice((state) => state.way !== null);
  return <StopKey label={words.stop.button} isDisabled={!exists} onStop={() => device.halt()} />;
}
