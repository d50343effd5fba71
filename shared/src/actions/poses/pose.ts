// Named poses of one robot: where some or all of its servos are, in the person's own positions and in the unit they were
// captured in. One immutable book, checked by one schema; applying a pose is only noted here. Knows no session, no storage.

import * as z from 'zod/mini';
import type { ServoTarget } from '../../protocol/commands.ts';
import { NAME_LENGTH } from '../robot/robot.ts';
import type { TextFlaw } from '../versionedText.ts';
import { runningId, targetSchema } from '../schemas.ts';

/** `home`: every servo at its home. `rest`: the pose marked as such, else home. */
export const POSE_VERBS = ['home', 'rest'] as const;

/** How long the way to a pose may be asked to take. */
export const POSE_MS = { min: 0, max: 30_000 } as const;

export const poseRefSchema = z.union([z.enum(POSE_VERBS), runningId]);
export type PoseRef = z.infer<typeof poseRefSchema>;

const poseSchema = z.strictObject({
  /** Never used twice, so an undone pose comes back as itself; means nothing outside its book. */
  id: runningId,
  name: z.string().check(z.trim(), z.minLength(1), z.maxLength(NAME_LENGTH)),
  unit: z.enum(['us', 'steps']),
  targets: z.array(targetSchema).check(z.minLength(1), z.maxLength(253)),
});

export const poseBookSchema = z.strictObject({
  poses: z.array(poseSchema).check(z.maxLength(1000)),
  restId: z.nullable(runningId),
  /** What the robot was sent to last by a pose; it may have moved since. */
  applied: z.nullable(poseRefSchema),
  nextId: runningId,
});

export type Pose = Readonly<Omit<z.infer<typeof poseSchema>, 'targets'>> & {
  readonly targets: readonly ServoTarget[];
};

export type PoseBook = Readonly<Omit<z.infer<typeof poseBookSchema>, 'poses'>> & {
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
