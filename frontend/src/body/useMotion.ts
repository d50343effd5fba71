// Calls a function with a servo's motion on each animation frame in which it changed: needles and numbers that move by
// themselves are drawn past React, and a robot at rest costs nothing.

import type { ServoMotion } from '#shared/session/state.ts';
import { useStores } from '../stores/stores.ts';
import { useFollow } from '../ui/useFollow.ts';
import { motionInFrame } from './motionInFrame.ts';

export function useMotion(servo: number, draw: (motion: ServoMotion) => void): void {
  const { device } = useStores();
  useFollow({ read: () => motionInFrame(device, servo), isSame: sameMotion, draw });
}

/** The same for several servos that are drawn as one. */
export function useMotions(servos: readonly number[], draw: () => void): void {
  const { device } = useStores();
  useFollow({
    read: () => servos.map((servo) => motionInFrame(device, servo)),
    isSame: sameMotions,
    draw,
  });
}

function sameMotions(some: readonly ServoMotion[], others: readonly ServoMotion[]): boolean {
  return (
    some.length === others.length &&
    some.every((one, index) => {
      const other = others[index];
      return other !== undefined && sameMotion(one, other);
    })
  );
}

function sameMotion(one: ServoMotion, other: ServoMotion): boolean {
  return one.target === other.target && one.estimated === other.estimated;
}
