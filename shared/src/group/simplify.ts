// A recorded motion becomes keys: of all samples only those that straight ways would miss by more than a chosen error (after
// Ramer, Douglas and Peucker), servo by servo, and at common times where that costs nothing. Knows no recording and no board.

import { sortedTargets } from '../codec/commands.ts';
import { emptyGroup, type ActionGroup } from './group.ts';
import { newMoment, withMoments } from './moments.ts';

export interface Sample {
  readonly atMs: number;
  readonly servo: number;
  readonly position: number;
}

export interface SimplifyOptions {
  readonly name: string;
  readonly unit: ActionGroup['unit'];
  /** At each sample its servo is no farther away than this; samples count in whole positions and milliseconds. */
  readonly maxErrorUnits: number;
  /** How long the way to the first pose takes: the recording begins behind it. */
  readonly leadMs: number;
}

type Place = Omit<Sample, 'servo'>;

/** One servo's samples in the order of time, and which of them are keys: the first and the last always. */
interface Trail {
  readonly servo: number;
  readonly places: readonly Place[];
  readonly indexAt: ReadonlyMap<number, number>;
  readonly keys: readonly number[];
}

/** An empty group without samples. */
export function simplify(samples: readonly Sample[], options: SimplifyOptions): ActionGroup {
  const { name, unit, maxErrorUnits } = options;
  const trails = [...placesByServo(samples, options)].map(([servo, places]) => ({
    ...{ servo, places, keys: thinned(places, maxErrorUnits) },
    indexAt: new Map(places.map(({ atMs }, index) => [atMs, index])),
  }));
  const targets = new Map<number, { readonly servo: number; readonly position: number }[]>();
  for (const { servo, places, keys } of gathered(trails, maxErrorUnits))
    for (const { atMs, position } of keys.flatMap((key) => places[key] ?? []))
      targets.set(atMs, [...(targets.get(atMs) ?? []), { servo, position }]);
  const moments = [...targets].map(([atMs, own]) =>
    newMoment(atMs, sortedTargets(own), { easing: 'linear' }),
  );
  return withMoments(emptyGroup(name, unit), moments);
}

/** Of samples of one servo at the same millisecond the last one counts. */
function placesByServo(
  samples: readonly Sample[],
  { leadMs }: SimplifyOptions,
): ReadonlyMap<number, Place[]> {
  const begunMs = samples.reduce((first, { atMs }) => Math.min(first, atMs), Infinity);
  const byServo = new Map<number, Map<number, Place>>();
  for (const sample of samples.toSorted((one, other) => one.atMs - other.atMs)) {
    const atMs = Math.round(sample.atMs - begunMs) + leadMs;
    const own = byServo.get(sample.servo) ?? new Map<number, Place>();
    byServo.set(sample.servo, own.set(atMs, { atMs, position: Math.round(sample.position) }));
  }
  return new Map([...byServo].map(([servo, places]) => [servo, [...places.values()]]));
}

/** The fewest that halving finds, where each half is missed most. */
function thinned(places: readonly Place[], maxErrorUnits: number): readonly number[] {
  const keys = new Set([0, places.length - 1]);
  const open: (readonly [number, number])[] = [[0, places.length - 1]];
  for (let part = open.pop(); part !== undefined; part = open.pop()) {
    const [from, to] = part;
    const { index, units } = mostMissed(places, from, to);
    if (units <= maxErrorUnits) continue;
    keys.add(index);
    open.push([from, index], [index, to]);
  }
  return [...keys].sort((one, other) => one - other);
}

/** The place that the straight way from one to another misses by most. */
function mostMissed(places: readonly Place[], from: number, to: number) {
  const start = places[from];
  const end = places[to];
  let worst = { index: from, units: 0 };
  if (start === undefined || end === undefined) return worst;
  const slope = (end.position - start.position) / (end.atMs - start.atMs);
  for (let index = from + 1; index < to; index += 1) {
    const { atMs, position } = places[index] ?? start;
    const units = Math.abs(position - (start.position + slope * (atMs - start.atMs)));
    if (units > worst.units) worst = { index, units };
  }
  return worst;
}

/** Keys go to the moment before or behind theirs where every servo that is keyed with them can: each makes a frame less. */
function gathered(trails: readonly Trail[], maxErrorUnits: number): readonly Trail[] {
  const keyTimes = trails.flatMap(({ places, keys }) => keys.map((key) => places[key]?.atMs ?? 0));
  const times = [...new Set(keyTimes)].sort((one, other) => one - other);
  let now = trails;
  for (let index = 0; index < times.length;) {
    const atMs = times[index] ?? 0;
    const there = [times[index - 1], times[index + 1]]
      .map((toMs) => moved(now, atMs, toMs, maxErrorUnits))
      .find((after) => after !== null);
    if (there === undefined) {
      index += 1;
      continue;
    }
    now = there;
    times.splice(index, 1);
  }
  return now;
}

/** All keys of one moment at another one; null where one of them cannot go. */
function moved(
  trails: readonly Trail[],
  fromMs: number,
  toMs: number | undefined,
  maxErrorUnits: number,
): readonly Trail[] | null {
  const after: Trail[] = [];
  for (const trail of trails) {
    const key = trail.indexAt.get(fromMs) ?? -1;
    const there = trail.keys.includes(key) ? withKeyAt(trail, key, toMs, maxErrorUnits) : trail;
    if (there === null) return null;
    after.push(there);
  }
  return after;
}

/** Null where it is an end, has no sample there, or would miss one. */
function withKeyAt(trail: Trail, key: number, toMs: number | undefined, maxErrorUnits: number): Trail | null {
  const { places, keys, indexAt } = trail;
  const to = toMs === undefined ? undefined : indexAt.get(toMs);
  if (to === undefined || key === 0 || key === places.length - 1) return null;
  const others = new Set(keys.filter((index) => index !== key));
  const after = [...others.add(to)].sort((one, other) => one - other);
  const around = after.flatMap((index, at) => {
    const next = after[at + 1];
    return next !== undefined && next >= Math.min(key, to) && index <= Math.max(key, to)
      ? [[index, next] as const]
      : [];
  });
  const holds = around.every(([one, other]) => mostMissed(places, one, other).units <= maxErrorUnits);
  return holds ? { ...trail, keys: after } : null;
}
