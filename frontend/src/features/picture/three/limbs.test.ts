// The limbs of the ready robots, led by a hand: no servo is sent farther than the hand asks, and on the wire none is faster than a slider's.

import fc from 'fast-check';
import { expect, test } from 'vitest';
import { makeBlock } from '#shared/group/blockEdits.ts';
import { emptyGroup } from '#shared/group/group.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import {
  added,
  type Chain,
  type ChainJoint,
  lengthOf,
  minus,
  poseOfChain,
  rotationOfRpy,
  scaled,
  type Vec3,
} from '#shared/kinematics/model.ts';
import { readyRobot, type ReadyRobotId } from '#shared/profile/readyRobots.ts';
import { type Robot, servoOf } from '#shared/profile/robot.ts';
import { RANGE_MS } from '#shared/robot/timings.ts';
import { evenly } from '#shared/testing/cases.ts';
import { robotNames } from '../../../i18n/sentences.ts';
import { createTestPage } from '../../pageUnderTest.ts';
import { bodyLinks } from '../bodyLinks.ts';
import { type LedLimb, leadTo, pathOf, poseOfLimb, radiansOf, takeLimb } from './limbs.ts';

const MOST_TURN = 6;

/** As `limbsOfModel` finds them in the drawn scene. */
function limbsOf(robot: Robot): readonly LedLimb[] {
  const links = bodyLinks(robot) ?? [];
  return links
    .filter(({ joint }) => joint === 'tip')
    .flatMap((end) => {
      const joints: ChainJoint[] = [];
      const servos: number[] = [];
      for (let mount = end.mount; mount !== null;) {
        const carrier = links.find(({ name }) => name === mount?.on)?.mount ?? null;
        const servo = servoOf(robot, carrier?.servo ?? 0);
        if (carrier !== null && servo !== undefined) {
          const ends = [radiansOf(servo, servo.min), radiansOf(servo, servo.max)];
          joints.unshift({
            ...{ name: String(servo.servo), origin: carrier.at, axis: carrier.axis },
            ...{ rotation: rotationOfRpy(carrier.rpy), min: Math.min(...ends), max: Math.max(...ends) },
          });
          servos.unshift(servo.servo);
        }
        mount = carrier;
      }
      const tip = end.mount?.at ?? [0, 0, 0];
      const chain: Chain = { joints, tip, pointing: scaled(tip, 1 / lengthOf(tip)) };
      return joints.length < 3 ? [] : [{ tip: end.name, chain, servos }];
    });
}

test('the way of an end is the same by keys and by blocks alone', () => {
  const robot = readyRobot('arm', 'doc', robotNames('arm'));
  const [limb] = limbsOf(robot);
  const group = [1300, 1700, 1500].reduce(
    (sum, position) =>
      insertFrame(sum, sum.frames.length, {
        durationMs: 400,
        targets: [3, 4, 5, 6].map((servo) => ({ servo, position })),
      }),
    emptyGroup('Wave', 'us'),
  );
  const refs = group.frames.flatMap(({ id: frameId, targets }) =>
    targets.map(({ servo }) => ({ frameId, servo })),
  );
  const blocks = makeBlock(group, refs, 'All')!;
  expect(blocks.frames).toEqual([]);
  const [path, ofBlocks] = [group, blocks].map((one) => pathOf(limb!, robot, one, 'us'));
  expect(path?.length).toBeGreaterThan(10);
  expect(ofBlocks).toEqual(path);
});

const isLocked = (): boolean => false;
const direction = fc
  .tuple(evenly(-1, 1), evenly(-1, 1), evenly(-1, 1))
  .filter((way) => Math.hypot(...way) > 0.1)
  .map((way): Vec3 => scaled(way, 1 / Math.hypot(...way)));

const LIMBS = { arm: 1, humanoid16: 4, humanoid18: 4, hexapod18: 6 } as const;

test.each(Object.entries(LIMBS))('a limb of %s is moved no farther than the hand asks', (id, count) => {
  const robot = readyRobot(id as ReadyRobotId, 'lsc-24', robotNames(id as ReadyRobotId));
  const limbs = limbsOf(robot);
  expect(limbs).toHaveLength(count);
  /** As a share of the servo's way. In the middle and at the ends joints line up. */
  const place = fc.oneof(fc.constantFrom(0, 0.5, 1), evenly(0.48, 0.52), evenly(0, 1));
  const ways = fc.array(fc.record({ direction, m: fc.constantFrom(1e-3, 5e-3, 0.02) }), {
    minLength: 1,
    maxLength: 8,
  });
  fc.assert(
    fc.property(
      fc.constantFrom(...limbs),
      fc.array(place, { minLength: 6, maxLength: 6 }),
      ways,
      (limb, at, hand) => {
        const start = takeLimb(limb, robot, (servo) => {
          const share = at[limb.servos.indexOf(servo.servo)] ?? 0;
          return Math.round(servo.min + share * (servo.max - servo.min));
        })!;
        const { joints, tip } = limb.chain;
        const lengthM = joints.slice(1).reduce((sum, { origin }) => sum + lengthOf(origin), lengthOf(tip));
        let [leading, wished] = [start, poseOfLimb(start).tip];
        for (const { direction: way, m } of hand) {
          wished = added(wished, scaled(way, m));
          const led = leadTo(leading, robot, {
            ...{ tip: wished, rise: null, isLocked, mode: { how: 'follow', askedM: m } },
          });
          for (const [index, angle] of led.leading.angles.entries())
            expect(Math.abs(angle - (leading.angles[index] ?? NaN))).toBeLessThanOrEqual(
              (MOST_TURN * m) / lengthM + 1e-9,
            );
          leading = led.leading;
        }
      },
    ),
  );
});

test.each(['doc', 'xarm', 'openarm-new'] as const)(
  'the first touch of a straight arm on %s moves no pulse faster than a slider, nor the base by more than a few degrees',
  async (profile) => {
    const { position } = FAMILIES[profile];
    const page = await createTestPage(new Map(), { profile, family: FAMILIES[profile] });
    const { clock, device, channel } = page;
    const robot = readyRobot('arm', profile, robotNames('arm'));
    const [limb] = limbsOf(robot);
    const home = robot.servos.map(({ servo, home: at }) => ({ servo, position: at }));
    device.move(home, 2000);
    await clock.advance(8000);
    const pulses = (): readonly number[] => robot.servos.map(({ servo }) => channel.board.pulse(servo));
    expect(pulses()).toEqual(home.map(({ position: at }) => at));

    // 12 mm in 220 ms, as a hand that takes hold of it.
    let leading = takeLimb(limb!, robot, ({ home: at }) => at)!;
    const start = poseOfLimb(leading).tip;
    const way = scaled([1, 1, -1.4], 1 / Math.hypot(1, 1, 1.4));
    const seen = [pulses()];
    for (let step = 1; step <= 11; step++) {
      const wished = added(start, scaled(way, (step * 12e-3) / 11));
      const mode = { how: 'follow', askedM: 12e-3 / 11 } as const;
      const led = leadTo(leading, robot, { tip: wished, rise: null, isLocked, mode });
      leading = led.leading;
      device.drag(led.targets, 'hand');
      for (let ms = 0; ms < 20; ms += 5) {
        await clock.advance(5);
        seen.push(pulses());
      }
    }
    for (let ms = 0; ms < 1000; ms += 5) {
      await clock.advance(5);
      seen.push(pulses());
    }
    const span = position.max - position.min;
    // Of 100 ms: two ticks of the board more, and one unit each tick.
    for (const [index, now] of seen.slice(20).entries())
      for (const [servo, pulse] of now.entries())
        expect(Math.abs(pulse - (seen[index]?.[servo] ?? NaN))).toBeLessThanOrEqual(
          (span * 140) / RANGE_MS + 7,
        );
    const [first, last] = [seen[0] ?? [], seen.at(-1) ?? []];
    const degrees = robot.servos.map(
      (servo, index) =>
        Math.abs(radiansOf(servo, last[index] ?? NaN) - radiansOf(servo, first[index] ?? NaN)) *
        (180 / Math.PI),
    );
    expect(Math.max(...degrees)).toBeGreaterThan(3);
    expect(Math.max(...degrees)).toBeLessThan(14);
    expect(lengthOf(minus(poseOfChain(limb!.chain, leading.angles).tip, start))).toBeGreaterThan(4e-3);
    await page.session.close();
    channel.board.powerOff();
  },
);
