// What six legs of three servos show: left front, middle, rear are servos 1 to 9, right ones 10 to 18; each leg turns, lifts and bends.
// Both sides are built as mirrors.

import type { Example, ExampleFrame, Turns } from './example.ts';

interface Leg {
  /** Forward. */
  readonly swing: number;
  readonly lift: number;
}

const LEG_COUNT = 6;
const LEFT_LEGS = 3;

/** Every other leg, the middle one of the other side with it. */
const isInFirstTripod = (leg: number): boolean => (leg < LEFT_LEGS ? leg % 2 === 0 : leg === 4);

function legs(place: (leg: number) => Leg): Turns {
  return Object.fromEntries(
    Array.from({ length: LEG_COUNT }, (_, leg) => {
      const side = leg < LEFT_LEGS ? 1 : -1;
      const { swing, lift } = place(leg);
      return [swing, lift, lift * 0.5].map((turn, joint) => [leg * 3 + joint + 1, turn * side]);
    }).flat(),
  ) as Turns;
}

const STAND = { swing: 0, lift: 0 };
const SWING = 0.15;
const LIFT = 0.3;

const to = (durationMs: number, place: (leg: number) => Leg): ExampleFrame => ({
  durationMs,
  turns: legs(place),
});

/** One tripod lifts and swings forward while the other one pushes. */
const step = (first: boolean): readonly ExampleFrame[] => {
  const isSwung = (leg: number): boolean => isInFirstTripod(leg) === first;
  return [
    to(250, (leg) => ({ swing: 0, lift: isSwung(leg) ? LIFT : 0 })),
    to(250, (leg) => ({ swing: isSwung(leg) ? SWING : -SWING, lift: 0 })),
  ];
};

const TRIPOD_GAIT: Example = [
  to(1500, () => STAND),
  ...step(true),
  ...step(false),
  ...step(true),
  ...step(false),
  to(500, () => STAND),
];

const HIGH = -0.4;

const RISE: Example = [
  to(1500, () => ({ swing: 0, lift: 0.4 })),
  to(1200, () => ({ swing: 0, lift: HIGH })),
  to(600, () => ({ swing: 0, lift: HIGH })),
  to(1200, () => STAND),
];

/** The front left leg greets, the others stand. */
const greeting = (swing: number, lift: number) => (leg: number) => (leg === 0 ? { swing, lift } : STAND);

const WAVE: Example = [
  to(1500, () => STAND),
  to(700, greeting(0.2, 0.6)),
  ...[0.45, 0, 0.45, 0].map((swing) => to(350, greeting(swing, 0.6))),
  to(700, () => STAND),
];

export const HEXAPOD_EXAMPLES = { wave: WAVE, tripodGait: TRIPOD_GAIT, rise: RISE };
