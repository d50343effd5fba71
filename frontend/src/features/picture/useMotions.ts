// Calls a function on each animation frame in which one of several servos moved that are drawn as one: past React, and a robot at rest
// costs nothing.

import type { ServoMotion } from '#shared/robot/state.ts';
import { useStores } from '../stores.ts';
import { useFollow } from '../../ui/useEachFrame.ts';
import { motionInFrame } from './motionInFrame.ts';

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
