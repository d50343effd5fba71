// What an arm of six shows: gripper 1, wrist roll 2, wrist 3, elbow 4, shoulder 5, base 6. A gripper closes upwards.

import type { Example, Turns } from './example.ts';

const REST: Turns = { 1: 0, 2: 0, 3: 0.35, 4: 0.5, 5: -0.35, 6: 0 };
const UP: Turns = { ...REST, 3: 0.1, 4: 0.1, 5: 0 };

const to = (durationMs: number, turns: Turns) => ({ durationMs, turns });

const pose = (change: Turns, from = REST): Turns => ({ ...from, ...change });

const WAVE: Example = [
  to(1200, REST),
  to(900, UP),
  to(350, pose({ 2: 0.4, 6: 0.15 }, UP)),
  to(450, pose({ 2: -0.4, 6: -0.15 }, UP)),
  to(450, pose({ 2: 0.4, 6: 0.15 }, UP)),
  to(450, pose({ 2: -0.4, 6: -0.15 }, UP)),
  to(350, UP),
  to(1000, REST),
];

const BOW: Example = [
  to(1200, UP),
  to(1100, pose({ 3: 0.55, 4: 0.35, 5: -0.45 })),
  to(500, pose({ 3: 0.55, 4: 0.35, 5: -0.45 })),
  to(1100, UP),
];

const OPEN = -0.5;
const CLOSED = 0.4;

/** Above a thing, down to it, and up again, turned to one side. */
const reach = (base: number, gripBefore: number, gripAfter: number): Example => [
  to(900, pose({ 1: gripBefore, 6: base })),
  to(800, pose({ 1: gripBefore, 3: 0.45, 4: 0.35, 5: -0.6, 6: base })),
  to(400, pose({ 1: gripAfter, 3: 0.45, 4: 0.35, 5: -0.6, 6: base })),
  to(800, pose({ 1: gripAfter, 6: base })),
];

const PICK_AND_PLACE: Example = [
  to(1200, pose({ 1: OPEN })),
  ...reach(-0.45, OPEN, CLOSED),
  ...reach(0.45, CLOSED, OPEN),
  to(900, pose({ 1: OPEN })),
];

const LOOK_AROUND: Example = [
  to(1200, UP),
  to(1000, pose({ 6: -0.5, 3: 0.2 }, UP)),
  to(500, pose({ 6: -0.5, 3: -0.1 }, UP)),
  to(1600, pose({ 6: 0.5, 3: -0.1 }, UP)),
  to(500, pose({ 6: 0.5, 3: 0.2 }, UP)),
  to(1000, REST),
];

export const ARM_EXAMPLES = {
  wave: WAVE,
  bow: BOW,
  pickAndPlace: PICK_AND_PLACE,
  lookAround: LOOK_AROUND,
};
