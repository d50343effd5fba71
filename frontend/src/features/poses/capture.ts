// A pose that was captured by a key has its name typed next; Enter leads back to where it was captured.

import { useEffect, useState, type RefObject } from 'react';
import { poseOf, type Pose, addPose } from '#shared/profile/pose.ts';
import { usePoses, useView, type Stores } from '../stores.ts';
import { words } from '../../i18n/words.ts';

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

// Keeps the pose that the robot was asked for in the book of poses, under a name of its own. Moves nothing.

/** Returns its name. */
export function capturePose({ device, poses, view }: Pick<Stores, 'device' | 'poses' | 'view'>): string {
  const { family } = device.store.getState();
  const { nextId } = poses.book.store.getState().present;
  const pose = { name: words.poses.newName({ number: nextId }), unit: family.unit, targets: device.pose() };
  poses.book.edit(
    () => words.poses.steps.capture({ name: pose.name }),
    (book) => addPose(book, pose),
  );
  view.setState({ selectedPose: nextId });
  return pose.name;
}
