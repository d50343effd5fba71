// How long it takes to estimate where a large motion makes a robot touch itself: as many keys as the largest group of a board has, on
// the two bodies with the most links. In the page that runs in a worker.

import { frameAngles } from '#shared/group/frames.ts';
import { collisionsOf } from '#shared/kinematics/collision.ts';
import { readyRobot, type ReadyRobotId } from '#shared/profile/readyRobots.ts';
import { positionOf, type Robot } from '#shared/profile/robot.ts';
import { createRandom } from '#shared/simulator/faults.ts';
import { linkModelOf } from '../frontend/src/features/picture/bodyLinks.ts';
import { amount } from './amounts.ts';
import type { Figure } from './figure.ts';
import { median } from './statistics.ts';

const KEYS = amount(8_160, 360);
const FRAME_MS = 500;
/** Each servo goes somewhere else in each frame, this far from home at most: a whole body that moves for minutes. */
const MOST_DEGREES = 17;
const SEED = 255;
const RUNS = amount(5, 1);
const LIMIT_MS = 2_000;

export function measureCollision(): Figure[] {
  return (['humanoid18', 'hexapod18'] as const).map((id) => {
    const robot = robotNamed(id);
    const model = linkModelOf(robot);
    const motion = frameAngles(framesOf(robot), robot);
    if (model === null) throw new Error(`no model of ${id}`);
    const taken = Array.from({ length: RUNS }, () => {
      const beganMs = performance.now();
      collisionsOf(model, motion);
      return performance.now() - beganMs;
    });
    return {
      key: id === 'humanoid18' ? 'collision.checkMs' : 'collision.checkHexapodMs',
      value: median(taken),
      unit: 'ms',
      limit: { atMost: LIMIT_MS },
      note: `${motion.length} frames of all ${robot.servos.length} servos of a ${robot.body} at random, median of ${RUNS}`,
    };
  });
}

const robotNamed = (id: ReadyRobotId): Robot =>
  readyRobot(id, 'doc', { robot: id, role: (role) => role, limb: (limb) => limb });

function framesOf({ servos }: Robot) {
  const random = createRandom(SEED);
  return Array.from({ length: Math.floor(KEYS / servos.length) }, () => ({
    durationMs: FRAME_MS,
    targets: servos.map((servo) => ({
      servo: servo.servo,
      position: positionOf(servo, (random() * 2 - 1) * MOST_DEGREES),
    })),
  }));
}
