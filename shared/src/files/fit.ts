// What of a group does not fit the current board and robot, and frames filled as other programs play them. What does not fit is
// listed, never changed: that is the person's to decide. Knows groups, robots and family rows; no file.

import type { Frame } from '../codec/commands.ts';
import type { ActionGroup } from '../group/group.ts';
import { frameEnds, positionAt, tracksOf } from '../group/tracks.ts';
import { positionRange, type Family, type Range } from '../codec/families.ts';
import { servoOf, type Robot } from '../profile/robot.ts';

// Frames as other programs play them: each servo in each frame, because they know nothing of a servo that is still
// under way. One without a key before has no position yet and stays out. Straight ways only.

interface Filled {
  readonly frames: readonly Frame[];
  /** Which frames got positions that the group does not name, counted from 1. */
  readonly completed: readonly number[];
  /** Which still lack a servo of the group, because it is unknown where it stands. */
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

type MisfitCode = 'unit' | 'frameCount' | 'slot' | 'duration' | 'servoCount' | 'servo' | 'position';

export interface Misfit {
  readonly code: MisfitCode;
  readonly servo: number | null;
  /** In which frames, counted from 1. */
  readonly frames: readonly number[];
  /** From the smallest to the largest value that does not fit. */
  readonly values: Range;
  readonly allowed: Range;
}

interface Value {
  readonly frame: number;
  readonly value: number;
}

export function misfitsOf(group: ActionGroup, family: Family, robot: Robot): readonly Misfit[] {
  const { frames, slot } = group;
  const durations = frames.map(({ durationMs }, index) => ({ frame: index + 1, value: durationMs }));
  const counts = frames.map(({ targets }, index) => ({ frame: index + 1, value: targets.length }));
  return [
    ...(group.unit === family.unit ? [] : [OTHER_UNIT]),
    ...misfit('frameCount', [{ frame: 0, value: frames.length }], { min: 0, max: family.framesPerGroup }),
    ...(slot === null ? [] : misfit('slot', [{ frame: 0, value: slot }], family.slot)),
    ...misfit('duration', durations, family.durationMs),
    ...misfit('servoCount', counts, { min: 0, max: family.servosPerFrame }),
    ...servoMisfits(group, family, robot),
  ];
}

const NOTHING: Range = { min: 0, max: 0 };
export const OTHER_UNIT: Misfit = {
  code: 'unit',
  servo: null,
  frames: [],
  values: NOTHING,
  allowed: NOTHING,
};

function servoMisfits({ frames, unit }: ActionGroup, family: Family, robot: Robot): readonly Misfit[] {
  const positions = new Map<number, Value[]>();
  frames.forEach(({ targets }, index) => {
    for (const { servo, position } of targets) {
      const known = positions.get(servo) ?? [];
      if (known.push({ frame: index + 1, value: position }) === 1) positions.set(servo, known);
    }
  });
  return [...positions]
    .sort(([one], [other]) => one - other)
    .flatMap(([servo, values]) => {
      const named = values.map(({ frame }) => ({ frame, value: servo }));
      const unknown = misfit('servo', named, family.servo, servo);
      if (unknown.length > 0 || unit !== family.unit) return unknown;
      return misfit('position', values, servoOf(robot, servo) ?? positionRange(family, servo), servo);
    });
}

function misfit(
  code: MisfitCode,
  values: readonly Value[],
  { min, max }: Range,
  servo: number | null = null,
): readonly Misfit[] {
  const outside = values.filter(({ value }) => value < min || value > max);
  const frames = outside.map(({ frame }) => frame);
  const extent = outside.reduce<Range>(
    (range, { value }) => ({ min: Math.min(range.min, value), max: Math.max(range.max, value) }),
    { min: Infinity, max: -Infinity },
  );
  return outside.length === 0 ? [] : [{ code, servo, frames, values: extent, allowed: { min, max } }];
}
