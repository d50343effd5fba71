// What the models of the ready robots say of the examples, and of motions that are known to hit.

import { expect, test } from 'vitest';
import { FAMILIES } from '#shared/codec/families.ts';
import { compile } from '#shared/group/compile.ts';
import { exampleGroup, examplesFor } from '#shared/group/examples/examples.ts';
import { frameAngles } from '#shared/group/frames.ts';
import { maxErrorOf } from '#shared/group/group.ts';
import { collisionsOf } from '#shared/kinematics/collision.ts';
import { READY_ROBOTS, readyRobot, type ReadyRobotId } from '#shared/profile/readyRobots.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { linkModelOf } from './bodyLinks.ts';
import { JOINT } from './pose.ts';

const MODELLED = ['arm', 'hand', 'humanoid16', 'humanoid18', 'hexapod18'] as const;
const names = { robot: 'Robot', role: (role: string) => role, limb: (limb: string) => limb };

const robots = MODELLED.flatMap((id: ReadyRobotId) =>
  READY_ROBOTS[id].boards.map((board) => ({ id, board, robot: readyRobot(id, board, names) })),
);

test.each(robots)('no example makes $id on $board touch itself or the floor', ({ board, robot }) => {
  const model = linkModelOf(robot);
  if (model === null) throw new Error('a body without a model');
  const family = FAMILIES[board];
  for (const example of examplesFor(robot)) {
    const group = exampleGroup(example, robot, example);
    const { frames } = compile(group, { family, robot, maxErrorUnits: maxErrorOf(group, family) });
    expect(collisionsOf(model, frameAngles(frames, robot)), example).toEqual([]);
  }
});

const ARM = readyRobot('arm', 'doc', names);

function placesOf(robot: Robot, targets: readonly (readonly [servo: number, position: number])[]) {
  const model = linkModelOf(robot);
  const frames = [
    { durationMs: 500, targets: robot.servos.map(({ servo, home }) => ({ servo, position: home })) },
    { durationMs: 1000, targets: targets.map(([servo, position]) => ({ servo, position })) },
  ];
  return model === null ? null : collisionsOf(model, frameAngles(frames, robot));
}

test('an arm that folds onto itself hits with its hand, after it has left home', () => {
  // Bus servos turn farther than a quarter from home.
  const places = placesOf(readyRobot('arm', 'bus-ctrl', names), [
    [JOINT.elbow, 1000],
    [JOINT.wrist, 1000],
  ]);
  expect(places?.[0]).toMatchObject({ kind: 'self' });
  expect(places?.[0]?.servos).not.toContain(null);
  expect(places?.[0]?.fromMs).toBeGreaterThan(600);
});

test('an arm that lies down hits the floor with its gripper', () => {
  const places = placesOf(ARM, [
    [JOINT.shoulder, 2500],
    [JOINT.elbow, 1800],
  ]);
  expect(places?.some(({ kind, servos }) => kind === 'floor' && servos[0] === JOINT.gripper)).toBe(true);
});

test('a body without a description has no model, nor one that its owner has imported a model for', () => {
  expect(linkModelOf(readyRobot('plain6', 'doc', names))).toBeNull();
  const model = { id: '0123456789abcdef', fileName: 'arm.zip', end: null };
  expect(linkModelOf({ ...ARM, model })).toBeNull();
});
