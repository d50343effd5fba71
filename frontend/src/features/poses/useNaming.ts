// A pose that was captured by a key has its name typed next; Enter leads back to where it was captured.

import { useEffect, useState, type RefObject } from 'react';
import { poseOf, type Pose } from '#shared/profile/pose.ts';
import { usePoses, useView } from '../stores.ts';

// The pose that is selected, if there is one.

export function useSelectedPose(): Pose | undefined {
  const id = useView((state) => state.selectedPose);
  return usePoses(({ present }) => poseOf(present, id));
}

export interface Captured {
  readonly pose: number;
  readonly from: Element;
}

/** To be called with what was captured; `list` is around its card. */
export function useNaming(list: RefObject<HTMLElement | null>): (captured: Captured) => void {
  const [captured, setCaptured] = useState<Captured | null>(null);

  useEffect(() => {
    if (captured === null) return;
    const { pose, from } = captured;
    const name = list.current?.querySelector<HTMLInputElement>(`[data-pose='${pose}'] input`);
    if (!name) return;
    const key = (event: KeyboardEvent): void => {
      if (event.key !== 'Enter' || !(from instanceof HTMLElement)) return;
      // Else what gets the focus is pressed by the same key.
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
