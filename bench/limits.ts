// Which figures are not what they should be. Knows figures; measures nothing.

import type { Figure } from './figure.ts';
import { withUnit } from './table.ts';

/** A line for each figure beyond its limit. */
export function missed(figures: readonly Figure[]): readonly string[] {
  return figures.flatMap(({ key, value, unit, limit }) => {
    if (limit === undefined) return [];
    const [word, wanted] = 'atMost' in limit ? ['at most', limit.atMost] : ['at least', limit.atLeast];
    const holds = 'atMost' in limit ? value <= wanted : value >= wanted;
    return holds
      ? []
      : [`missed: ${key} is ${withUnit(value, unit)}, wanted ${word} ${withUnit(wanted, unit)}`];
  });
}
