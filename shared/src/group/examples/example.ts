// What an example is made of, before there is a robot. Knows no servo's limits.

import type { Easing } from '../group.ts';

/** By servo number: -1 is as far as it turns one way from home, 1 the other way. */
export type Turns = Readonly<Record<number, number>>;

export interface ExampleFrame {
  readonly durationMs: number;
  readonly turns: Turns;
  readonly easing?: Easing;
}

/** Servos that no frame turns stay out of it. */
export type Example = readonly ExampleFrame[];
