// How long the inverse kinematics of an arm takes for a place that was typed, the slow way: a drag begins near its end.

import {
  type Chain,
  type ChainJoint,
  NO_ROTATION,
  poseOfChain,
  type Vec3,
} from '#shared/kinematics/model.ts';
import { reach } from '#shared/kinematics/inverse.ts';
import { amount } from './amounts.ts';
import type { Figure } from './figure.ts';
import { percentile } from './statistics.ts';

const PLACES = amount(20_000, 2_000);
const REST = [0, 0.3, 0.3, 0.3];
/** Their square roots are irrational, so the places are spread evenly. */
const STRIDES = [2, 3, 5, 7];

/** As the model of a six-servo arm has them: base, shoulder, elbow, wrist. */
const ARM: Chain = {
  joints: [joint([0, 0, 0.03], [0, 0, 1]), ...[0.045, 0.104, 0.089].map((z) => joint([0, 0, z], [0, 1, 0]))],
  tip: [0, 0, 0.145],
  pointing: [0, 0, 1],
};

function joint(origin: Vec3, axis: Vec3): ChainJoint {
  return { name: '', origin, axis, rotation: NO_ROTATION, min: -Math.PI / 2, max: Math.PI / 2 };
}

export function measureIk(): Figure[] {
  const solved = Array.from({ length: PLACES }, (_, index) => {
    const angles = ARM.joints.map(
      ({ min, max }, one) => min + (max - min) * ((index * Math.sqrt(STRIDES[one] ?? 2)) % 1),
    );
    const { tip } = poseOfChain(ARM, angles);
    const beganMs = performance.now();
    const { missM } = reach(ARM, REST, { tip, rise: null });
    return { tookMs: performance.now() - beganMs, missMm: missM * 1000 };
  });
  const note = `${PLACES} places all over what an arm of four joints reaches, from where it rests`;
  return [
    {
      key: 'ik.solveMsP99',
      value: percentile(
        solved.map(({ tookMs }) => tookMs),
        99,
      ),
      unit: 'ms',
      limit: { atMost: 2 },
      note,
    },
    {
      key: 'ik.missMmMax',
      value: Math.max(...solved.map(({ missMm }) => missMm)),
      unit: 'mm',
      limit: { atMost: 1 },
      note,
    },
  ];
}
