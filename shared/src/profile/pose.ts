// Named poses of one robot: where some or all of its servos are, in the person's own positions and in the unit they were
// captured in. One immutable book, checked by one schema; applying a pose is only noted here. Knows no session, no storage.

import * as v from 'valibot';
import type { ServoTarget } from '../codec/commands.ts';
import { NAME_LENGTH } from './robot.ts';
import type { TextFlaw } from '../document/versionedText.ts';
import { runningId, targetSchema } from '../document/schemas.ts';

/** `home`: every servo at its home. `rest`: the pose marked as such, else home. */
export const POSE_VERBS = ['home', 'rest'] as const;

/** How long the way to a pose may be asked to take. */
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

export const poseBookSchema = v.strictObject({
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
