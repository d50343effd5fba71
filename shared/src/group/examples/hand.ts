// What a hand shows: five fingers, thumb 1 to little 5, and the base 6. A finger bends upwards.

import type { Example, Turns } from './example.ts';

const FINGERS = [1, 2, 3, 4, 5];
const STRAIGHT = -0.8;
const BENT = 0.8;

const fingers = (straight: readonly number[], base = 0): Turns =>
  Object.fromEntries([
    ...FINGERS.map((finger) => [finger, straight.includes(finger) ? STRAIGHT : BENT]),
    [6, base],
  ]) as Turns;

const to = (durationMs: number, turns: Turns) => ({ durationMs, turns });

const OPEN = fingers(FINGERS);
const FIST = fingers([]);

const WAVE: Example = [
  to(1200, OPEN),
  ...[0.35, -0.35, 0.35, -0.35].map((base) => to(500, fingers(FINGERS, base))),
  to(500, OPEN),
];

const CLOSE: Example = [to(1200, OPEN), to(700, FIST), to(500, FIST), to(700, OPEN)];

const COUNT: Example = [
  to(1200, FIST),
  ...[[2], [2, 3], [2, 3, 4], [2, 3, 4, 5], FINGERS].flatMap((shown) => [
    to(450, fingers(shown)),
    to(450, fingers(shown)),
  ]),
];

const POINT: Example = [
  to(1200, FIST),
  to(600, fingers([2])),
  to(700, fingers([2], -0.4)),
  to(1200, fingers([2], 0.4)),
  to(700, fingers([2])),
  to(800, OPEN),
];

export const HAND_EXAMPLES = { wave: WAVE, fist: CLOSE, countToFive: COUNT, point: POINT };
