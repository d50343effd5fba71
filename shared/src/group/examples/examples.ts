// Groups to begin with, for each kind of body: written as turns of named joints, made into positions within each servo's limits.
// Names come from the caller. Knows robots and groups; no session.

import type { ServoTarget } from '../../codec/commands.ts';
import { FAMILIES } from '../../codec/families.ts';
import { emptyGroup, type ActionGroup } from '../group.ts';
import { insertFrame } from '../groupEdits.ts';
import { servoOf, type BodyKind, type Robot, type RobotServo } from '../../profile/robot.ts';
import { ARM_EXAMPLES } from './arm.ts';
import { type Example, type Turns, plainExamples } from './example.ts';
import { HAND_EXAMPLES } from './hand.ts';
import { HEXAPOD_EXAMPLES } from './hexapod.ts';
import { HUMANOID_EXAMPLES } from './humanoid.ts';

export const EXAMPLE_IDS = [
  ...(['wave', 'bow', 'pickAndPlace', 'lookAround', 'fist', 'countToFive', 'point'] as const),
  ...(['squat', 'cheer', 'tripodGait', 'rise', 'ripple', 'sweep'] as const),
] as const;
export type ExampleId = (typeof EXAMPLE_IDS)[number];

type Examples = Readonly<Partial<Record<ExampleId, Example>>>;

const EXAMPLES: Readonly<Record<Exclude<BodyKind, 'plain'>, Examples>> = {
  arm: ARM_EXAMPLES,
  hand: HAND_EXAMPLES,
  humanoid: HUMANOID_EXAMPLES,
  hexapod: HEXAPOD_EXAMPLES,
};

/** What such a body can show, in the order offered. */
export function examplesFor(robot: Robot): readonly ExampleId[] {
  const examples = examplesOf(robot);
  return EXAMPLE_IDS.filter((id) => examples[id] !== undefined);
}

/** The example as a group of its own, slow enough for its servos; empty where such a body has none. */
export function exampleGroup(id: ExampleId, robot: Robot, name: string): ActionGroup {
  const example = examplesOf(robot)[id] ?? [];
  const group = { ...emptyGroup(name, FAMILIES[robot.board].unit), robot: robot.name };
  return example.reduce((sum, { durationMs, turns, easing = 'inOut' }) => {
    const targets = robot.servos.flatMap((servo) => targetOf(servo, turns));
    const leastMs = wayMs(robot, sum.frames.at(-1)?.targets ?? [], targets);
    return insertFrame(sum, sum.frames.length, {
      durationMs: Math.max(durationMs, leastMs),
      easing,
      targets,
    });
  }, group);
}

/** Well below what common servos can, also in the middle of an eased way, which is twice as steep. */
const DEGREES_PER_MS = 0.24 / 2;
/** The tick of most boards. */
const TICK_MS = 20;

function wayMs(robot: Robot, from: readonly ServoTarget[], to: readonly ServoTarget[]): number {
  const before = new Map(from.map(({ servo, position }) => [servo, position]));
  const degrees = to.map(({ servo, position }) => {
    const perUnit = servoOf(robot, servo)?.degreesPerUnit ?? 0;
    return Math.abs(position - (before.get(servo) ?? position)) * perUnit;
  });
  return Math.ceil(Math.max(0, ...degrees) / DEGREES_PER_MS / TICK_MS) * TICK_MS;
}

const examplesOf = ({ body, servos }: Robot): Examples =>
  body === 'plain' ? plainExamples(servos.map(({ servo }) => servo)) : EXAMPLES[body];

function targetOf(servo: RobotServo, turns: Turns): readonly ServoTarget[] {
  const turn = turns[servo.servo];
  if (turn === undefined) return [];
  const { min, max, home, isReversed } = servo;
  const towards = isReversed ? -turn : turn;
  const reach = towards < 0 ? home - min : max - home;
  return [{ servo: servo.servo, position: Math.round(home + towards * reach) }];
}
