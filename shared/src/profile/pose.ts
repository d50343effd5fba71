// Named poses of one robot: where some or all of its servos are, in the person's own positions and in the unit they were
// captured in. One immutable book, checked by one schema, as text and back, and its edits; applying a pose is only noted here.
// Knows no session, no storage.

import * as v from 'valibot';
import { type ServoTarget, sortedTargets } from '../codec/commands.ts';
import { NAME_LENGTH } from './robot.ts';
import {
  type TextFlaw,
  runningId,
  targetSchema,
  readVersioned,
  versionedSchema,
  versionedText,
  type Read,
} from '../document/schema.ts';
import { sameTargets } from './poseShapes.ts';

/** `home`: every servo at its home. `rest`: the pose marked as such, else home. */
export const POSE_VERBS = ['home', 'rest'] as const;

/** The range of durations of a move to a pose. */
export const POSE_MS = { min: 0, max: 30_000 } as const;

export const poseRefSchema = v.union([v.picklist(POSE_VERBS), runningId]);
export type PoseRef = v.InferOutput<typeof poseRefSchema>;

const poseSchema = v.strictObject({
  /** Never used twice, so an undone pose comes back as itself; means nothing outside its book. */
  id: runningId,
  name: v.pipe(v.string(), v.trim(), v.minLength(1), v.maxLength(NAME_LENGTH)),
  unit: v.picklist(['us', 'steps']),
  targets: v.pipe(v.array(targetSchema), v.minLength(1), v.maxLength(253)),
});

const poseBookSchema = v.strictObject({
  poses: v.pipe(v.array(poseSchema), v.maxLength(1000)),
  restId: v.nullable(runningId),
  /** What the robot was sent to last by a pose; it may have moved since. */
  applied: v.nullable(poseRefSchema),
  nextId: runningId,
});

export type Pose = Readonly<Omit<v.InferOutput<typeof poseSchema>, 'targets'>> & {
  readonly targets: readonly ServoTarget[];
};

export type PoseBook = Readonly<Omit<v.InferOutput<typeof poseBookSchema>, 'poses'>> & {
  readonly poses: readonly Pose[];
};

export const EMPTY_BOOK: PoseBook = { poses: [], restId: null, applied: null, nextId: 1 };

export function poseOf(book: PoseBook, id: number | null): Pose | undefined {
  return book.poses.find((pose) => pose.id === id);
}

/** What cannot be in a book, as words for people; null where nothing is wrong. */
export function flawOfBook({ poses, restId, applied, nextId }: PoseBook): TextFlaw | null {
  const ids = poses.map(({ id }) => id);
  if (new Set(ids).size < ids.length || ids.some((id) => id >= nextId)) return { code: 'sameNumber', at: '' };
  const named = [restId, typeof applied === 'number' ? applied : null];
  if (named.some((id) => id !== null && !ids.includes(id))) return { code: 'poseMissing', at: '' };
  const double = poses.find(
    ({ targets }) => new Set(targets.map(({ servo }) => servo)).size < targets.length,
  );
  return double === undefined ? null : { code: 'servoTwice', at: double.name };
}

// A book of poses as text with a version, and back; the same for storage and files. Reading trusts nothing and says
// what is wrong.

const FORMAT = 'servodeck-poses';

const fileSchema = versionedSchema(FORMAT, poseBookSchema);

export const poseBookToText = (book: PoseBook): string => versionedText(FORMAT, book);

export function poseBookFromText(text: string): Read<PoseBook> {
  return readVersioned(text, fileSchema, flawOfBook);
}

// Every change of a book of poses, as pure functions: (book, arguments) → book. One that changes nothing returns the
// very same object, so that a history can leave it out.

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
