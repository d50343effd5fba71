// Keeps the pose that the robot was asked for in the book of poses, under a name of its own. Moves nothing.

import { addPose } from '#shared/profile/pose.ts';
import type { Stores } from '../stores.ts';
import { words } from '../../i18n/words.ts';

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
