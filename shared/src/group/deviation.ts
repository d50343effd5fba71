// How far a straight way misses a servo's course, exactly: courses are lines and parabolas, so what counts are the ends of
// their legs and where a leg is as steep as the way. Knows no frame and no board.

import { CURVES } from './easings.ts';
import { legAfter, legAt, type Course, type Leg } from './courses.ts';

/** Of fractions: a miss that is less is none. */
export const ROUNDING = 1e-6;

/** A straight way from one place to another. */
export interface Straight {
  readonly fromMs: number;
  readonly toMs: number;
  readonly from: number;
  readonly to: number;
}

export interface Miss {
  readonly units: number;
  readonly atMs: number;
}

/** Of a whole group. */
export interface Deviation extends Miss {
  readonly servo: number;
}

/** The greatest one, or the first beyond `enough`. */
export function missOf({ legs, restPosition }: Course, way: Straight, enough = Infinity): Miss {
  const slope = (way.to - way.from) / (way.toMs - way.fromMs);
  let worst: Miss = { units: 0, atMs: way.fromMs };
  const look = (position: number, atMs: number): void => {
    const units = Math.abs(position - (way.from + slope * (atMs - way.fromMs)));
    if (units > worst.units) worst = { units, atMs };
  };
  let index = legAfter(legs, way.fromMs);
  for (let atMs = way.fromMs; atMs < way.toMs && worst.units <= enough; index += 1) {
    const leg = legs[index];
    const untilMs = Math.min(way.toMs, leg?.toMs ?? Infinity);
    for (const at of leg === undefined ? [atMs, untilMs] : turns(leg, slope, atMs, untilMs))
      look(leg === undefined ? restPosition : legAt(leg, at), at);
    atMs = untilMs;
  }
  return worst;
}

/** Where the leg can be farthest from a way of `slope`, between two instants. */
function turns(
  { fromMs, toMs, from, to, easing }: Leg,
  slope: number,
  sinceMs: number,
  untilMs: number,
): number[] {
  const lengthMs = toMs - fromMs;
  const steep = to === from ? [] : CURVES[easing].asSteepAs((slope * lengthMs) / (to - from));
  const within = steep.map((share) => fromMs + share * lengthMs).filter((at) => at > sinceMs && at < untilMs);
  return [sinceMs, ...within, untilMs];
}
