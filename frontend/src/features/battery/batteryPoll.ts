// Asks for the battery when a link becomes ready, soon after a run, and every five seconds while nothing moves: on some boards
// any packet disturbs what runs, and under load the voltage sags anyway. A board that stayed silent is asked again only by a
// person, and a shared one by its link.

import { BATTERY_AFTER_RUN_MS, BATTERY_EVERY_MS } from '#shared/robot/timings.ts';
import type { Device, DeviceState } from '../../robot/device.ts';

/** Returns a function that ends it. `visible` is asked before each question: a hidden page asks nothing. */
export function pollBattery(device: Device, visible: () => boolean): () => void {
  let cancelTimer = (): void => undefined;
  const askIn = (ms: number): void => {
    cancelTimer();
    cancelTimer = device.clock.after(ms, tick);
  };
  const tick = (): void => {
    askIn(BATTERY_EVERY_MS);
    if (visible() && mayAsk(device.store.getState()) && device.isAtRest()) device.watchBattery();
  };
  tick();
  const unsubscribe = device.store.subscribe((state, before) => {
    const isNew = state.snapshot.link.status === 'ready' && before.snapshot.link.status !== 'ready';
    const hasEnded = isIdle(state) && !isIdle(before);
    if (isNew) tick();
    else if (hasEnded) askIn(BATTERY_AFTER_RUN_MS);
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
  const { link, battery, lease } = state.snapshot;
  return lease === null && canReadBattery(state) && link.status === 'ready' && battery.kind !== 'silent';
}
