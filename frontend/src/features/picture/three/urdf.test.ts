// Models of the ready robots: one tree of links, a joint for each servo, and limits that are the servo's own.

import { expect, test } from 'vitest';
import { XMLParser } from 'fast-xml-parser';
import { degreesOf, type Robot } from '#shared/profile/robot.ts';
import { readyRobot, type ReadyRobotId } from '#shared/profile/readyRobots.ts';
import { jointName, urdfOf } from './urdf.ts';

interface Joint {
  readonly name: string;
  readonly type: string;
  readonly parent: string;
  readonly child: string;
  readonly limit: readonly [lower: number, upper: number] | null;
}

interface Parsed {
  readonly robot: {
    readonly link: readonly { readonly '@_name': string }[];
    readonly joint: readonly {
      readonly '@_name': string;
      readonly '@_type': string;
      readonly parent: { readonly '@_link': string };
      readonly child: { readonly '@_link': string };
      readonly limit?: { readonly '@_lower': string; readonly '@_upper': string };
    }[];
  };
}

const parser = new XMLParser({
  ignoreAttributes: false,
  isArray: (name) => name === 'link' || name === 'joint',
});

function parsed(of: Robot): { readonly links: readonly string[]; readonly joints: readonly Joint[] } {
  const { robot } = parser.parse(urdfOf(of) ?? '') as Parsed;
  return {
    links: robot.link.map((link) => link['@_name']),
    joints: robot.joint.map(({ parent, child, limit, ...joint }) => ({
      name: joint['@_name'],
      type: joint['@_type'],
      parent: parent['@_link'],
      child: child['@_link'],
      limit: limit === undefined ? null : [Number(limit['@_lower']), Number(limit['@_upper'])],
    })),
  };
}

const robotNamed = (id: ReadyRobotId): Robot =>
  readyRobot(id, 'doc', { robot: id, role: (role, servo) => `${role} ${servo}`, limb: (limb) => limb });

const MODELLED = ['arm', 'hand', 'humanoid16', 'humanoid18', 'hexapod18'] as const;

test.each(MODELLED)('%s is one tree, each link on one joint', (id) => {
  const { links, joints } = parsed(robotNamed(id));
  expect(new Set(links).size).toBe(links.length);
  expect(joints.map(({ child }) => child).toSorted()).toEqual(
    links.filter((name) => name !== 'base_link').toSorted(),
  );
  for (const { parent } of joints) expect(links).toContain(parent);
});

test.each(MODELLED)('%s has a joint with its own limits for each servo', (id) => {
  const robot = robotNamed(id);
  const { joints } = parsed(robot);
  for (const servo of robot.servos) {
    const joint = joints.find(({ name }) => name === jointName(servo.servo));
    const ends = [servo.min, servo.max].map((end) => (degreesOf(servo, end) * Math.PI) / 180);
    expect(joint?.type).toBe('revolute');
    expect(joint?.limit?.[0]).toBeCloseTo(Math.min(...ends), 5);
    expect(joint?.limit?.[1]).toBeCloseTo(Math.max(...ends), 5);
  }
});

test('an arm without its wrist servo still has a hand', () => {
  const arm = robotNamed('arm');
  const { joints } = parsed({ ...arm, servos: arm.servos.filter(({ servo }) => servo !== 3) });
  expect(joints.find(({ child }) => child === 'wrist')?.type).toBe('fixed');
});

test('a body without a description has no model', () => {
  expect(urdfOf(robotNamed('plain6'))).toBeNull();
});
