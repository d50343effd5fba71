// Compiled frames as data: the differences between two lists, and the angles of a robot's joints over time, for estimates on its model. The
// way to the first pose is left out, because the position before it is unknown. Pure; knows no geometry.

import type { Frame } from '../codec/commands.ts';
import { totalDurationMs } from './group.ts';
import { degreesOf, servoOf, type Robot } from '../profile/robot.ts';

export interface FramesComparison {
  readonly isSame: boolean;
  readonly frameCounts: readonly [one: number, other: number];
  readonly durationsMs: readonly [one: number, other: number];
  /** From 0; null where one is the other, as far as both go. */
  readonly firstDifferent: number | null;
  /** In that frame: its time, or the servos that go elsewhere, each with where; null where only one has it. */
  readonly servos: readonly {
    readonly servo: number;
    readonly positions: readonly [one: number | null, other: number | null];
  }[];
}

export function compareFrames(one: readonly Frame[], other: readonly Frame[]): FramesComparison {
  const first = one.findIndex((frame, index) => other[index] !== undefined && !same(frame, other[index]));
  const firstDifferent = first === -1 ? null : first;
  return {
    isSame: first === -1 && one.length === other.length,
    frameCounts: [one.length, other.length],
    durationsMs: [totalDurationMs(one), totalDurationMs(other)],
    firstDifferent,
    servos: firstDifferent === null ? [] : differing(one[firstDifferent], other[firstDifferent]),
  };
}

function same(one: Frame, other: Frame): boolean {
  return one.durationMs === other.durationMs && differing(one, other).length === 0;
}

function differing(one: Frame | undefined, other: Frame | undefined): FramesComparison['servos'] {
  const [before, after] = [positionsIn(one), positionsIn(other)];
  return [...new Set([...before.keys(), ...after.keys()])]
    .sort((a, b) => a - b)
    .map((servo) => ({
      servo,
      positions: [before.get(servo) ?? null, after.get(servo) ?? null] as const,
    }))
    .filter(({ positions: [from, to] }) => from !== to);
}

const positionsIn = (frame: Frame | undefined): ReadonlyMap<number, number> =>
  new Map(frame?.targets.map(({ servo, position }) => [servo, position]));

const RADIANS = Math.PI / 180;

/** Milliseconds from the beginning of the group, radians by servo. Servos that no frame has moved so far are at home. */
export function frameAngles(
  frames: readonly Frame[],
  robot: Robot,
): readonly { readonly atMs: number; readonly angles: ReadonlyMap<number, number> }[] {
  let atMs = 0;
  let angles: ReadonlyMap<number, number> = new Map();
  return frames.map(({ durationMs, targets }) => {
    const turned = targets.flatMap(({ servo: number, position }) => {
      const servo = servoOf(robot, number);
      return servo === undefined ? [] : [[number, degreesOf(servo, position) * RADIANS] as const];
    });
    atMs += durationMs;
    angles = new Map([...angles, ...turned]);
    return { atMs, angles };
  });
}
