// Frames as other programs play them: each servo in each frame, because they know nothing of a servo that is still under way.
// One without a key before has no position yet and stays out. Straight ways only.

import type { Frame } from '../../protocol/commands.ts';
import type { ActionGroup } from '../group/group.ts';

export interface Filled {
  readonly frames: readonly Frame[];
  /** Which frames got positions that the group does not name, counted from 1. */
  readonly completed: readonly number[];
  /** Which still lack a servo of the group, because nobody knows where it stands. */
  readonly lacking: readonly number[];
}

export function filled({ frames }: ActionGroup): Filled {
  const servos = [...new Set(frames.flatMap(({ targets }) => targets.map(({ servo }) => servo)))].sort(
    (one, other) => one - other,
  );
  const poses = frames.map(({ targets }) => new Map(targets.map(({ servo, position }) => [servo, position])));
  const ways = servos.map((servo) => {
    const keys = poses.map((pose) => pose.get(servo) ?? null);
    return { servo, positions: wayOf(frames, keys) };
  });
  const whole = frames.map(({ durationMs }, index) => ({
    durationMs,
    targets: ways.flatMap(({ servo, positions }) => {
      const position = positions[index] ?? null;
      return position === null ? [] : [{ servo, position }];
    }),
  }));
  const numbersWhere = (isSo: (before: Frame, after: Frame) => boolean): readonly number[] =>
    whole.flatMap((after, index) => (isSo(frames[index] ?? after, after) ? [index + 1] : []));
  return {
    frames: whole,
    completed: numbersWhere((before, after) => after.targets.length > before.targets.length),
    lacking: numbersWhere((_, after) => after.targets.length < servos.length),
  };
}

/** Where a servo is at the end of each frame, from where it has a key. */
function wayOf(frames: readonly Frame[], keys: readonly (number | null)[]): readonly (number | null)[] {
  const way = [...keys];
  let last = -1;
  keys.forEach((position, index) => {
    if (position === null) return;
    if (last !== -1) between(frames, way, last, index);
    last = index;
  });
  return last === -1 ? way : way.fill(way[last] ?? null, last);
}

function between(frames: readonly Frame[], way: (number | null)[], from: number, to: number): void {
  const [start, end] = [way[from] ?? 0, way[to] ?? 0];
  const spanMs = lengthMs(frames, from, to);
  let passedMs = 0;
  for (let index = from + 1; index < to; index++) {
    passedMs += frames[index]?.durationMs ?? 0;
    way[index] = Math.round(start + (end - start) * (spanMs === 0 ? 1 : passedMs / spanMs));
  }
}

const lengthMs = (frames: readonly Frame[], from: number, to: number): number =>
  frames.slice(from + 1, to + 1).reduce((sum, { durationMs }) => sum + durationMs, 0);
