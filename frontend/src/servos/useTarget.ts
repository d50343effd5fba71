// A servo's target out of React's rounds: for what is drawn at once past React, and for what is drawn by React no more often than
// a number can be read.

import { useEffect, useEffectEvent, useLayoutEffect, useRef, useState } from 'react';
import type { Device } from '../stores/device.ts';
import { useStores } from '../stores/stores.ts';
import { turnOf, useEachFrame } from '../ui/useEachFrame.ts';

const READ_EACH_MS = 100;

export const targetOf = ({ store }: Device, servo: number): number | null =>
  store.getState().targets[servo] ?? null;

/** `show` is called with each new target, and each time the component is drawn. */
export function useTarget(servo: number, show: (target: number | null) => void): void {
  const { device } = useStores();
  const showNow = useEffectEvent(show);
  useLayoutEffect(() => show(targetOf(device, servo)));
  useEffect(
    () =>
      device.store.subscribe(({ targets }, before) => {
        if (targets[servo] !== before.targets[servo]) showNow(targets[servo] ?? null);
      }),
    [device, servo],
  );
}

/** The target, and a function that takes it over at once. */
export function useReadTarget(servo: number): readonly [number | null, () => void] {
  const { device } = useStores();
  const [read, setRead] = useState(() => targetOf(device, servo));
  const atMs = useRef(-turnOf(READ_EACH_MS));
  useEachFrame(() => {
    if (targetOf(device, servo) === read || performance.now() - atMs.current < READ_EACH_MS) return;
    atMs.current = performance.now();
    setRead(targetOf(device, servo));
  });
  return [read, () => setRead(targetOf(device, servo))];
}
