// What a humanoid of 16 or 18 shows, standing: left leg 1 to 5 from the foot up, left arm 6 to 8, the right side eight further on.
// Both sides are named as one and mirrored; the feet stay under the body.

import type { Example, Turns } from './example.ts';

const RIGHT = 8;

interface Stand {
  /** Bent, in parts of what the knee turns. */
  readonly knees?: number;
  /** Forward at the hips. */
  readonly lean?: number;
  /** Raised sideways, left and right. */
  readonly arms?: readonly [left: number, right: number];
  readonly elbows?: readonly [left: number, right: number];
}

/** The ankle and thigh take back what the knee bends, so that the body sinks upright. The sides are built as mirrors. */
function stand({ knees = 0, lean = 0, arms = [0, 0], elbows = [0, 0] }: Stand): Turns {
  const side = (arm: number, elbow: number) => [0, knees / 2, -knees, knees / 2 + lean, 0, elbow, arm, 0];
  const left = side(arms[0], elbows[0]).map((turn, index) => [index + 1, -turn]);
  const right = side(arms[1], elbows[1]).map((turn, index) => [index + 1 + RIGHT, turn]);
  return Object.fromEntries([...left, ...right]) as Turns;
}

const to = (durationMs: number, pose: Stand) => ({ durationMs, turns: stand(pose) });

const up = (elbow: number): Stand => ({ arms: [0, 0.7], elbows: [0, elbow] });

const WAVE: Example = [
  to(1500, {}),
  to(900, up(0)),
  ...[0.35, -0.2, 0.35, -0.2].map((elbow) => to(400, up(elbow))),
  to(900, {}),
];

const BOW: Example = [
  to(1500, {}),
  to(1100, { lean: 0.3, arms: [0.1, 0.1] }),
  to(600, { lean: 0.3, arms: [0.1, 0.1] }),
  to(1100, {}),
];

const SQUAT: Example = [
  to(1500, {}),
  ...[0.7, 0, 0.7, 0].map((knees) => to(1200, { knees, arms: [knees, knees] })),
];

const CHEER: Example = [
  to(1500, {}),
  ...[0.75, 0.5, 0.75, 0.5, 0.75].map((arm, index) =>
    to(index === 0 ? 900 : 350, { arms: [arm, arm], elbows: [0.2, 0.2] }),
  ),
  to(900, {}),
];

export const HUMANOID_EXAMPLES = { wave: WAVE, bow: BOW, squat: SQUAT, cheer: CHEER };
