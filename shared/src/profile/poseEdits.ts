// Every change of a book of poses, as pure functions: (book, arguments) → book. One that changes nothing returns the very
// same object, so that a history can leave it out.

import type { ServoTarget } from '../codec/commands.ts';
import { sortedTargets } from '../group/group.ts';
import { NAME_LENGTH } from './robot.ts';
import { poseOf, type Pose, type PoseBook, type PoseRef } from './pose.ts';
import { sameTargets } from './poseShapes.ts';

type NewPose = Omit<Pose, 'id'>;

export function addPose(book: PoseBook, pose: NewPose): PoseBook {
  return insertPose(book, book.poses.length, pose);
}

/** Puts a copy right behind the pose, by as much of the name as a name may be long. */
export function duplicatePose(book: PoseBook, id: number, wanted: string): PoseBook {
  const pose = poseOf(book, id);
  const name = wanted.slice(0, NAME_LENGTH).trim();
  return pose === undefined ? book : insertPose(book, book.poses.indexOf(pose) + 1, { ...pose, name });
}

export function removePose(book: PoseBook, id: number): PoseBook {
  const poses = book.poses.filter((pose) => pose.id !== id);
  if (poses.length === book.poses.length) return book;
  const { restId, applied } = book;
  return { ...book, poses, restId: restId === id ? null : restId, applied: applied === id ? null : applied };
}

/** Takes the pose out and puts it back as number `index` of the resulting list. */
export function movePose(book: PoseBook, id: number, index: number): PoseBook {
  const pose = poseOf(book, id);
  const to = Math.max(0, Math.min(index, book.poses.length - 1));
  if (pose === undefined || book.poses[to] === pose) return book;
  const others = book.poses.filter((one) => one !== pose);
  return { ...book, poses: others.toSpliced(to, 0, pose) };
}

export function renamePose(book: PoseBook, id: number, name: string): PoseBook {
  return changePose(book, id, (pose) => (pose.name === name ? pose : { ...pose, name }));
}

/** A pose without any servo would be none: then nothing changes. The robot was not sent to what it is now. */
export function setPose(
  book: PoseBook,
  id: number,
  targets: readonly ServoTarget[],
  unit?: Pose['unit'],
): PoseBook {
  const changed = changePose(book, id, (pose) =>
    targets.length === 0 || ((unit ?? pose.unit) === pose.unit && sameTargets(pose.targets, targets))
      ? pose
      : { ...pose, unit: unit ?? pose.unit, targets: sortedTargets(targets) },
  );
  return changed !== book && wentTo(book) === id ? { ...changed, applied: null } : changed;
}

/** The pose that the robot was sent to last, by whatever name. */
const wentTo = ({ applied, restId }: PoseBook): PoseRef | null =>
  applied === 'rest' ? (restId ?? 'home') : applied;

/** null: home is where the robot rests. */
export function markRest(book: PoseBook, restId: number | null): PoseBook {
  return restId === book.restId ? book : { ...book, restId, applied: wentTo(book) };
}

/** null: the robot was sent somewhere between poses. */
export function markApplied(book: PoseBook, applied: PoseRef | null): PoseBook {
  return applied === book.applied ? book : { ...book, applied };
}

/** All poses of another book behind ours, under numbers of our own; what it marks as rest or applied is its own affair. */
export function withPosesOf(book: PoseBook, other: PoseBook): PoseBook {
  return other.poses.reduce<PoseBook>(addPose, book);
}

function insertPose(book: PoseBook, index: number, { name, unit, targets }: NewPose): PoseBook {
  const added = { id: book.nextId, name, unit, targets: sortedTargets(targets) };
  return { ...book, poses: book.poses.toSpliced(index, 0, added), nextId: book.nextId + 1 };
}

function changePose(book: PoseBook, id: number, change: (pose: Pose) => Pose): PoseBook {
  const before = poseOf(book, id);
  if (before === undefined) return book;
  const after = change(before);
  return after === before
    ? book
    : { ...book, poses: book.poses.map((pose) => (pose === before ? after : pose)) };
}
