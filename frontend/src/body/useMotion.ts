// Calls a function with a servo's motion on each animation frame in which it changed: needles and numbers that move by
// themselves are drawn past React, and a robot at rest costs nothing.

import { useRef } from 'react';
import type { ServoMotion } from '#shared/session/state.ts';
import { useStores } from '../stores/stores.ts';
import { useEachFrame } from '../ui/useEachFrame.ts';
import { motionInFrame } from './motionInFrame.ts';

export function useMotion(servo: number, draw: (motion: ServoMotion) => void): void {
  const { device } = useStores();
  const drawn = useRef<ServoMotion | null>(null);
  useEachFrame(() => {
    const motion = motionInFrame(device, servo);
    if (drawn.current !== null && sameMotion(drawn.current, motion)) return;
    drawn.current = motion;
    draw(motion);
  });
}

/** The same for several servos that are drawn as one. */
export function useMotions(servos: readonly number[], draw: () => void): void {
  const { device } = useStores();
  const drawn = useRef<readonly ServoMotion[]>([]);
  useEachFrame(() => {
    const motions = servos.map((servo) => motionInFrame(device, servo));
    const isSame =
      motions.length === drawn.current.length &&
      motions.every((motion, index) => {
        const before = drawn.current[index];
        return before !== undefined && sameMotion(before, motion);
      });
    if (isSame) return;
    drawn.current = motions;
    draw();
  });
}

function sameMotion(one: ServoMotion, other: ServoMotion): boolean {
  return one.target === other.target && one.estimated === other.estimated;
}
