// Each servo's way as a board can go it: its keys on the board's ticks, no jump faster than a move can be; and how far a straight
// way misses it, exactly. Continuous from the beginning of the group to its end. Knows a board's time; no frame.

import type { Family } from '../codec/families.ts';
import { curveOf, type Easing } from './curves.ts';
import type { Key, Track, Tracks } from './tracks.ts';

export interface Leg {
  readonly fromMs: number;
  readonly toMs: number;
  readonly from: number;
  readonly to: number;
  readonly easing: Easing;
  /** The one whose key it leads to. */
  readonly frameId: number;
  /** As fast as the servo can: how long that takes is not specified. */
  readonly isJump: boolean;
}

export interface Course {
  readonly servo: number;
  /** One follows the other from 0 on; behind the last one the servo rests. */
  readonly legs: readonly Leg[];
  readonly restPosition: number;
  /** When it comes from wherever it was to its first key; 0 where its start is known. */
  readonly knownFromMs: number;
  /** Keys that would have to be reached in no time: another one falls on the same tick, or the beginning does. */
  readonly missed: readonly Key[];
  /** How far a key is off its time at most. */
  readonly shiftedMs: number;
}

/** Between two ends of frames at least, and every end is a multiple of it. */
export function gridMs({ motion, shortestMoveMs }: Family): number {
  return Math.ceil(shortestMoveMs / motion.tickMs) * motion.tickMs;
}

export const onGrid = (atMs: number, stepMs: number): number => Math.round(atMs / stepMs) * stepMs;

/** `start` is where servos stand when the group begins; the others wait at their first key, from wherever they came. */
export function coursesOf(
  tracks: Tracks,
  stepMs: number,
  start: ReadonlyMap<number, number>,
): readonly Course[] {
  return [...tracks.values()].map((track) => courseOf(track, stepMs, start.get(track.servo)));
}

function courseOf({ servo, keys }: Track, stepMs: number, start: number | undefined): Course {
  const tickOf = ({ atMs }: Key): number => onGrid(atMs, stepMs);
  // The last one on each tick.
  const byTick = new Map(keys.map((key) => [tickOf(key), key]));
  const atOnce = byTick.get(0);
  const reached = [...byTick.values()].filter((key) => key !== atOnce);
  const isUnknown = start === undefined && atOnce === undefined;
  const there = (key: Key): number | undefined =>
    tickOf(key) === 0 ? start : byTick.get(tickOf(key))?.position;
  let at: Place = { atMs: 0, position: start ?? (atOnce ?? reached[0])?.position ?? 0 };
  const legs = reached.flatMap((key, index) => {
    const to = { atMs: tickOf(key), position: key.position };
    const easing = isUnknown && index === 0 ? 'linear' : key.easing;
    const way = legsTo(at, to, { easing, frameId: key.frameId }, stepMs);
    at = to;
    return way;
  });
  return {
    ...{ servo, legs, restPosition: at.position },
    knownFromMs: isUnknown ? (legs[0]?.toMs ?? 0) : 0,
    missed: keys.filter((key) => there(key) !== key.position),
    shiftedMs: reached.reduce((most, key) => Math.max(most, Math.abs(tickOf(key) - key.atMs)), 0),
  };
}

interface Place {
  readonly atMs: number;
  readonly position: number;
}

/** A servo that holds stays until one step before the end. */
function legsTo(
  from: Place,
  { atMs, position }: Place,
  how: Pick<Leg, 'easing' | 'frameId'>,
  stepMs: number,
): Leg[] {
  const way = { fromMs: from.atMs, toMs: atMs, from: from.position, to: position, ...how, isJump: false };
  if (how.easing !== 'hold') return [way];
  const jumpMs = atMs - stepMs;
  const jump: Leg = { ...way, fromMs: jumpMs, easing: 'linear', isJump: true };
  const rest: Leg = { ...way, toMs: jumpMs, to: from.position, easing: 'linear' };
  return jumpMs > from.atMs ? [rest, jump] : [jump];
}

export function courseAt({ legs, restPosition }: Course, atMs: number): number {
  const leg = legs[legAfter(legs, atMs)];
  return leg === undefined ? restPosition : legAt(leg, atMs);
}

function legAt({ fromMs, toMs, from, to, easing }: Leg, atMs: number): number {
  return from + (to - from) * curveOf(easing).at((atMs - fromMs) / (toMs - fromMs));
}

/** The first leg that ends later. */
function legAfter(legs: readonly Leg[], atMs: number): number {
  let low = 0;
  let high = legs.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((legs[middle]?.toMs ?? Infinity) <= atMs) low = middle + 1;
    else high = middle;
  }
  return low;
}

// How far a straight way misses a servo's course, exactly: what counts are the ends of a course's legs and where a leg is as
// steep as the way.

/** Of fractions: a miss that is less is none. */
export const ROUNDING = 1e-6;

/** A straight way from one place to another. */
export interface Straight {
  readonly fromMs: number;
  readonly toMs: number;
  readonly from: number;
  readonly to: number;
}

interface Miss {
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
  const steep = to === from ? [] : curveOf(easing).asSteepAs((slope * lengthMs) / (to - from));
  const within = steep.map((share) => fromMs + share * lengthMs).filter((at) => at > sinceMs && at < untilMs);
  return [sinceMs, ...within, untilMs];
}
