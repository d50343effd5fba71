// Frames as other programs play them: each servo in each frame, because they know nothing of a servo that is still under way.
// One without a key before has no position yet and stays out. Straight ways only.

import type { Frame } from '../codec/commands.ts';
import type { ActionGroup } from '../group/group.ts';
import { frameEnds, positionAt, tracksOf } from '../group/tracks.ts';

export interface Filled {
  readonly frames: readonly Frame[];
  /** Which frames got positions that the group does not name, counted from 1. */
  readonly completed: readonly number[];
  /** Which still lack a servo of the group, because nobody knows where it stands. */
  readonly lacking: readonly number[];
}

export function filled({ frames }: ActionGroup): Filled {
  const tracks = tracksOf({ frames: frames.map((frame) => ({ ...frame, easing: 'linear' })) });
  const ends = frameEnds(frames);
  const whole = frames.map(({ durationMs, targets }, index) => {
    const own = new Map(targets.map(({ servo, position }) => [servo, position]));
    const all = [...tracks].flatMap(([servo, track]) => {
      const position = own.get(servo) ?? positionAt(track, ends[index] ?? 0);
      return position === null ? [] : [{ servo, position: Math.round(position) }];
    });
    return { durationMs, targets: all };
  });
  const numbersWhere = (isSo: (before: Frame, after: Frame) => boolean): readonly number[] =>
    whole.flatMap((after, index) => (isSo(frames[index] ?? after, after) ? [index + 1] : []));
  return {
    frames: whole,
    completed: numbersWhere((before, after) => after.targets.length > before.targets.length),
    lacking: numbersWhere((_, after) => after.targets.length < tracks.size),
  };
}
