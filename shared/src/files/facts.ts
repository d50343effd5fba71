// The entry of an action group or a robot in a list: computed from the document, or read from elsewhere by a schema. Does not know where
// documents are stored.

import * as v from 'valibot';
import { flattened } from '../group/flattened.ts';
import { motionLengthMs } from '../group/blocks.ts';
import { poseAt, type ActionGroup } from '../group/group.ts';
import type { PoseBook } from '../profile/pose.ts';
import { supplyOf } from '../profile/battery.ts';
import { homeTargets } from '../profile/poseShapes.ts';
import { BATTERY_POLICIES, limitsOnBoard, onBoard, type Robot } from '../profile/robot.ts';
import { FAMILIES } from '../codec/families.ts';
import { count, targetSchema, whole } from '../document/schema.ts';

interface FactsContext {
  readonly updatedAtMs: number;
  /** The current robot, for a group that does not say what it was made for. */
  readonly robot: string;
}

export function factsOf(group: ActionGroup, { updatedAtMs, robot }: FactsContext): GroupFacts {
  // The middle distinguishes groups: many begin and end at rest.
  const { frames } = flattened(group);
  const pose = poseAt(frames, Math.floor(frames.length / 2));
  return {
    kind: 'group',
    // Half a character, cut off at the length limit, could not be sent.
    name: group.name.toWellFormed(),
    robot: (group.robot === '' ? robot : group.robot).toWellFormed(),
    tags: group.tags.map((tag) => tag.toWellFormed()),
    updatedAtMs,
    frames: group.frames.length,
    durationMs: motionLengthMs(group),
    unit: group.unit,
    pose: [...pose].map(([servo, position]) => ({ servo, position })),
  };
}

// What a list says of a robot, worked out from it: its limits and poses as the board counts, for clients that move it
// without knowing its trims.

const MAX_POSITION = 0xffff;

/** Home is number 0. */
export function robotFactsOf(robot: Robot, { poses }: PoseBook, updatedAtMs: number): RobotFacts {
  const { warnMv, alarmMv } = supplyOf(robot);
  const home = { id: 0, name: 'home', unit: FAMILIES[robot.board].unit, targets: homeTargets(robot) };
  const all = [home, ...poses].map(({ id, name, unit, targets }) => ({
    ...{ id, name: name.toWellFormed(), unit },
    targets: onBoard(robot, targets).map(({ servo, position }) => ({ servo, position })),
  }));
  return {
    kind: 'robot',
    // Half a character, cut off at the length limit, could not be sent.
    name: robot.name.toWellFormed(),
    board: robot.board,
    updatedAtMs,
    limits: limitsOnBoard(robot).map((limits) => ({ ...limits, name: limits.name.toWellFormed() })),
    poses: all.filter(({ targets }) => targets.every(({ position }) => isSendable(position))),
    lowBatteryMv: warnMv,
    ...{ batteryPolicy: robot.batteryCare.policy, alarmMv },
  };
}

/** A trim may take a pose of another unit out of every board's range. */
const isSendable = (position: number): boolean => position >= 0 && position <= MAX_POSITION;

const name = v.pipe(v.string(), v.maxLength(64));

const groupFactsSchema = v.strictObject({
  kind: v.literal('group'),
  name,
  robot: name,
  tags: v.pipe(v.array(name), v.maxLength(20)),
  /** Milliseconds since 1970. */
  updatedAtMs: count,
  frames: count,
  durationMs: count,
  unit: v.picklist(['us', 'steps']),
  /** Its picture. */
  pose: v.pipe(v.array(targetSchema), v.maxLength(256)),
});

/** For the person who stores it: limits and poses in the units of the board. */
const robotFactsSchema = v.strictObject({
  kind: v.literal('robot'),
  name,
  board: name,
  updatedAtMs: count,
  limits: v.array(
    v.strictObject({
      servo: whole(0, 0xff),
      name: v.string(),
      min: whole(0, 0xffff),
      max: whole(0, 0xffff),
      /** In both limits already. */
      trim: v.optional(whole(-0xffff, 0xffff), 0),
    }),
  ),
  poses: v.array(
    v.strictObject({
      id: count,
      name: v.string(),
      unit: v.picklist(['us', 'steps']),
      targets: v.array(targetSchema),
    }),
  ),
  /** At or below, its battery is low: for notifications of the gateway. */
  lowBatteryMv: v.optional(v.nullable(count), null),
  /** What a battery at its alarm brings about; null where a version of before stored it. */
  batteryPolicy: v.optional(v.nullable(v.picklist(BATTERY_POLICIES)), null),
  alarmMv: v.optional(v.nullable(count), null),
});

export const factsSchema = v.variant('kind', [groupFactsSchema, robotFactsSchema]);

export type GroupFacts = v.InferOutput<typeof groupFactsSchema>;
export type RobotFacts = v.InferOutput<typeof robotFactsSchema>;
