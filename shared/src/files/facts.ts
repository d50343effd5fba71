// What a list says of an action group, worked out from the group. Knows no keeper's place.

import { poseAt, totalDurationMs, type ActionGroup } from '../group/group.ts';
import type { GroupFacts } from './factsShape.ts';

export interface FactsContext {
  readonly updatedAtMs: number;
  /** The robot at hand, for a group that does not say what it was made for. */
  readonly robot: string;
}

export function factsOf(group: ActionGroup, { updatedAtMs, robot }: FactsContext): GroupFacts {
  // The middle tells groups apart: many begin and end at rest.
  const pose = poseAt(group.frames, Math.floor(group.frames.length / 2));
  return {
    kind: 'group',
    // Half a character, cut off at the length limit, could not be sent.
    name: group.name.toWellFormed(),
    robot: (group.robot === '' ? robot : group.robot).toWellFormed(),
    tags: group.tags.map((tag) => tag.toWellFormed()),
    updatedAtMs,
    frames: group.frames.length,
    durationMs: totalDurationMs(group.frames),
    unit: group.unit,
    pose: [...pose].map(([servo, position]) => ({ servo, position })),
  };
}
