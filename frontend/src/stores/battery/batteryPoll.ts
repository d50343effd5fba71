// Asks for the battery when a link becomes ready, soon after a run, and every five seconds while nothing moves: on some boards
// any packet disturbs what runs, and under load the voltage sags anyway. A board that stayed silent is asked again only by a
// person.

import type { Device, DeviceState } from '../device/device.ts';

const INTERVAL_MS = 5000;
/** The last frame arrives, and the voltage comes back. */
const AFTER_RUN_MS = 500;

/** Returns a function that ends it. `visible` is asked before each question: a hidden page asks nothing. */
export function pollBattery(device: Device, visible: () => boolean): () => void {
  let cancelTimer = (): void => undefined;
  const askIn = (ms: number): void => {
    cancelTimer();
    cancelTimer = device.clock.after(ms, tick);
  };
  const tick = (): void => {
    askIn(INTERVAL_MS);
    if (visible() && mayAsk(device.store.getState()) && device.isAtRest()) device.watchBattery();
  };
  tick();
  const unsubscribe = device.store.subscribe((state, before) => {
    const isNew = state.snapshot.link.status === 'ready' && before.snapshot.link.status !== 'ready';
    const hasEnded = isIdle(state) && !isIdle(before);
    if (isNew) tick();
    else if (hasEnded) askIn(AFTER_RUN_MS);
  });
  return () => {
    unsubscribe();
    cancelTimer();
  };
}

export function canReadBattery({ family }: Pick<DeviceState, 'family'>): boolean {
  return family.answers.includes('readBattery');
}

const isIdle = ({ snapshot }: DeviceState): boolean => snapshot.activity.kind === 'idle';

function mayAsk(state: DeviceState): boolean {
  const { link, battery } = state.snapshot;
  return canReadBattery(state) && link.status === 'ready' && battery.kind !== 'silent';
}
