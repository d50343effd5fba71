// What an example is made of, before there is a robot, and examples for any servos in a row: small turns about home. Knows no servo's
// limits.

import type { Easing } from '../curves.ts';

/** By servo number: -1 is as far as it turns one way from home, 1 the other way. */
export type Turns = Readonly<Record<number, number>>;

export interface ExampleFrame {
  readonly durationMs: number;
  readonly turns: Turns;
  readonly easing?: Easing;
}

/** Servos that no frame turns stay out of it. */
export type Example = readonly ExampleFrame[];

const TURN = 0.25;
const STEP_MS = 300;

const each = (servos: readonly number[], turn: (index: number) => number): Turns =>
  Object.fromEntries(servos.map((servo, index) => [servo, turn(index)]));

export function plainExamples(servos: readonly number[]): {
  readonly ripple: Example;
  readonly sweep: Example;
} {
  const home = { durationMs: 1500, turns: each(servos, () => 0) };
  const count = Math.min(servos.length, 8);
  const ripple = Array.from({ length: 2 * count + 1 }, (_, step) => ({
    durationMs: STEP_MS,
    turns: each(servos, (index) => TURN * Math.sin(((step - (index % count)) * 2 * Math.PI) / count)),
  }));
  const sweep = [TURN, -TURN, 0].map((turn) => ({ durationMs: 1200, turns: each(servos, () => turn) }));
  return { ripple: [home, ...ripple, { ...home, durationMs: 900 }], sweep: [home, ...sweep] };
}
