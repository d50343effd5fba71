// Asks for the battery when a link becomes ready and every five seconds while nothing moves: on some boards any packet
// disturbs what runs, and under load the voltage sags anyway. A board that stayed silent is asked again only by a person.

import type { Device, DeviceState } from './device.ts';

const INTERVAL_MS = 5000;

/** Returns a function that ends it. `visible` is asked before each question: a hidden page asks nothing. */
export function pollBattery(device: Device, visible: () => boolean): () => void {
  let cancelTimer = (): void => undefined;
  const tick = (): void => {
    cancelTimer();
    cancelTimer = device.clock.after(INTERVAL_MS, tick);
    if (visible() && mayAsk(device.store.getState()) && device.isAtRest()) device.readBattery();
  };
  tick();
  const unsubscribe = device.store.subscribe((state, before) => {
    const isNew = state.snapshot.link.status === 'ready' && before.snapshot.link.status !== 'ready';
    if (isNew) tick();
  });
  return () => {
    unsubscribe();
    cancelTimer();
  };
}

export function canReadBattery({ family }: Pick<DeviceState, 'family'>): boolean {
  return family.answers.includes('readBattery');
}

function mayAsk(state: DeviceState): boolean {
  const { link, battery } = state.snapshot;
  return canReadBattery(state) && link.status === 'ready' && battery.kind !== 'silent';
}
