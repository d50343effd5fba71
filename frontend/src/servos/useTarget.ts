// A servo's target past React's rounds, no more often than it can be read.

import { useLayoutEffect, useState } from 'react';
import type { Device } from '../stores/device.ts';
import { useStores } from '../stores/stores.ts';
import { useFollow } from '../ui/useFollow.ts';

const READ_EACH_MS = 100;

export const targetOf = ({ store }: Device, servo: number): number | null =>
  store.getState().targets[servo] ?? null;

/** `show` is called no more often than it can be read, and each time the component is drawn. */
export function useReadableTarget(servo: number, show: (target: number | null) => void): void {
  const { device } = useStores();
  useLayoutEffect(() => show(targetOf(device, servo)));
  useFollow({ read: () => targetOf(device, servo), draw: show, eachMs: READ_EACH_MS });
}

/** The target, and a function that takes it over at once. */
export function useReadTarget(servo: number): readonly [number | null, () => void] {
  const { device } = useStores();
  const [read, setRead] = useState(() => targetOf(device, servo));
  useFollow({ read: () => targetOf(device, servo), draw: setRead, eachMs: READ_EACH_MS });
  return [read, () => setRead(targetOf(device, servo))];
}
