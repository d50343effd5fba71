// Drawing several servos as one picture. Apart from motion.ts, which is in the first load.

import type { ServoMotion } from '#shared/robot/state.ts';
import { useFollow } from '../../ui/useEachFrame.ts';
import { useStores } from '../stores.ts';
import { motionInFrame } from './motion.ts';

/** Calls `draw` in each frame in which one of the servos moved. A robot at rest costs nothing. */
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
