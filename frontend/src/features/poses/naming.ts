// Hooks for the selected pose, and for naming a pose that has just been captured.

import { useEffect, useState, type RefObject } from 'react';
import { poseOf, type Pose } from '#shared/profile/pose.ts';
import { usePoses, useView } from '../stores.ts';

export function useSelectedPose(): Pose | undefined {
  const id = useView((state) => state.selectedPose);
  return usePoses(({ present }) => poseOf(present, id));
}

export interface Captured {
  readonly pose: number;
  readonly from: Element;
}

/**
 * Returns a function to call with a pose captured by a key: the focus goes to its name in `list`, and Enter leads back to where the pose
 * was captured.
 */
export function useNaming(list: RefObject<HTMLElement | null>): (captured: Captured) => void {
  const [captured, setCaptured] = useState<Captured | null>(null);

  useEffect(() => {
    if (captured === null) return;
    const { pose, from } = captured;
    const name = list.current?.querySelector<HTMLInputElement>(`[data-pose='${pose}'] input`);
    if (!name) return;
    const key = (event: KeyboardEvent): void => {
      if (event.key !== 'Enter' || !(from instanceof HTMLElement)) return;
      // Otherwise the same key would press the element that gets the focus.
      event.preventDefault();
      from.focus();
    };
    const leave = (): void => setCaptured(null);
    name.focus();
    name.select();
    name.addEventListener('keydown', key);
    name.addEventListener('blur', leave);
    return () => {
      name.removeEventListener('keydown', key);
      name.removeEventListener('blur', leave);
    };
  }, [captured, list]);

  return setCaptured;
}
