// How a servo comes into its key: curves from (0, 0) to (1, 1), the share of the time across, the share of the way up. Each is known
// exactly where it is farthest from a straight way. Knows no key and no board.

import * as v from 'valibot';

/** `hold`: stays at the key before and jumps at the end, as fast as the servo can. */
export const EASINGS = ['linear', 'in', 'out', 'inOut', 'hold'] as const;
export type NamedEasing = (typeof EASINGS)[number];

/** A handle may stand beyond both keys, so that the servo swings past one of them, but not so far that a slip of the pen throws it. */
export const [LOWEST_HANDLE, HIGHEST_HANDLE] = [-2, 3] as const;

const time = v.pipe(v.number(), v.minValue(0), v.maxValue(1));
const way = v.pipe(v.number(), v.minValue(LOWEST_HANDLE), v.maxValue(HIGHEST_HANDLE));

/** A cubic Bézier by its two handles, as `cubic-bezier()` in CSS has them: x1, y1 at the key before, x2, y2 at the key itself. */
const bezierSchema = v.strictTuple([time, way, time, way]);
export type Bezier = Readonly<v.InferOutput<typeof bezierSchema>>;

export const easingSchema = v.union([v.picklist(EASINGS), bezierSchema]);
export type Easing = NamedEasing | Bezier;

interface Curve {
  /** The share of the way that is done after `share` of the time. */
  at(share: number): number;
  /** Where within the time it is just as steep as a straight way of `slope`: there it is farthest from such a way. */
  asSteepAs(slope: number): readonly number[];
}

const into: Curve = {
  at: (share) => share * share,
  asSteepAs: (slope) => [slope / 2],
};

const NAMED: Readonly<Record<NamedEasing, Curve>> = {
  linear: { at: (share) => share, asSteepAs: () => [] },
  in: into,
  out: {
    at: (share) => 1 - into.at(1 - share),
    asSteepAs: (slope) => [1 - slope / 2],
  },
  inOut: {
    at: (share) => (share < 0.5 ? into.at(2 * share) / 2 : 1 - into.at(2 - 2 * share) / 2),
    asSteepAs: (slope) => [slope / 4, 1 - slope / 4],
  },
  hold: { at: (share) => (share < 1 ? 0 : 1), asSteepAs: () => [] },
};

/** Where the way turns round because the curve swings past an end, as shares of the way. */
export function turnsOf(easing: Easing): readonly number[] {
  if (typeof easing === 'string') return [];
  const curve = curveOf(easing);
  return curve.asSteepAs(0).map(curve.at);
}

const known = new WeakMap<Bezier, Curve>();

export function curveOf(easing: Easing): Curve {
  if (typeof easing === 'string') return NAMED[easing];
  const before = known.get(easing);
  const curve = before ?? bezierCurve(easing);
  if (before === undefined) known.set(easing, curve);
  return curve;
}

/** at³ + bt² + ct, from 0 to 1 with `t`. */
interface Cubic {
  readonly a: number;
  readonly b: number;
  readonly c: number;
}

const cubic = (first: number, second: number): Cubic => ({
  ...{ a: 1 + 3 * (first - second), b: 3 * (second - 2 * first), c: 3 * first },
});
const cubicAt = ({ a, b, c }: Cubic, t: number): number => ((a * t + b) * t + c) * t;

function bezierCurve([x1, y1, x2, y2]: Bezier): Curve {
  const [x, y] = [cubic(x1, x2), cubic(y1, y2)];
  return {
    at: (share) => cubicAt(y, whereAt(x, share)),
    asSteepAs: (slope) =>
      roots(3 * (y.a - slope * x.a), 2 * (y.b - slope * x.b), y.c - slope * x.c)
        .filter((t) => t > 0 && t < 1)
        .map((t) => cubicAt(x, t)),
  };
}

const CLOSE = 1e-10;
const MOST_STEPS = 60;

/** Of the cubic that only rises, the `t` where it is `value`: Newton's steps, halved where they lead away. */
function whereAt(rising: Cubic, value: number): number {
  if (value <= 0 || value >= 1) return value <= 0 ? 0 : 1;
  let [low, high, t] = [0, 1, value];
  for (let step = 0; step < MOST_STEPS; step += 1) {
    const beyond = cubicAt(rising, t) - value;
    if (Math.abs(beyond) < CLOSE) break;
    if (beyond > 0) high = t;
    else low = t;
    const next = t - beyond / ((3 * rising.a * t + 2 * rising.b) * t + rising.c);
    t = next > low && next < high ? next : (low + high) / 2;
  }
  return t;
}

function roots(a: number, b: number, c: number): readonly number[] {
  if (Math.abs(a) < CLOSE) return Math.abs(b) < CLOSE ? [] : [-c / b];
  const discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return [];
  const root = Math.sqrt(discriminant);
  return [(-b - root) / (2 * a), (-b + root) / (2 * a)];
}

export function sameEasing(one: Easing, other: Easing): boolean {
  if (typeof one === 'string' || typeof other === 'string') return one === other;
  return one.every((value, index) => value === other[index]);
}

/** Where the handles of a curve that has a name are: exactly, but for `inOut`, which is two parabolas. */
const HANDLES_OF: Readonly<Record<Exclude<NamedEasing, 'hold'>, Bezier>> = {
  linear: [1 / 3, 1 / 3, 2 / 3, 2 / 3],
  in: [1 / 3, 0, 2 / 3, 1 / 3],
  out: [1 / 3, 2 / 3, 2 / 3, 1],
  inOut: [0.455, 0.03, 0.515, 0.955],
};

/** null: a jump has none. */
export function handlesOf(easing: Easing): Bezier | null {
  if (typeof easing !== 'string') return easing;
  return easing === 'hold' ? null : HANDLES_OF[easing];
}

const rounded = (share: number): number => Math.round(share * 1000) / 1000;

/** A handle as a document has it: a share of the time, and of the way. */
export const handleTime = (share: number): number => rounded(Math.min(1, Math.max(0, share)));
export const handleWay = (share: number): number =>
  rounded(Math.min(HIGHEST_HANDLE, Math.max(LOWEST_HANDLE, share)));

// A way that is cut in two at an instant continues as before, as near as handles with three decimals are.

/** After de Casteljau. */
export function partOf(easing: Easing, share: number, side: 'before' | 'behind'): Easing {
  const whole = easing === 'linear' ? null : handlesOf(easing);
  if (whole === null || share <= 0 || share >= 1) return easing;
  const [x1, y1, x2, y2] = whole;
  const t = whereAt(cubic(x1, x2), share);
  const [xs, ys] = [split([0, x1, x2, 1], t)[side], split([0, y1, y2, 1], t)[side]];
  const [width, height] = [xs[3] - xs[0], ys[3] - ys[0]];
  if (width < LEAST || Math.abs(height) < LEAST) return 'linear';
  const scaled = (index: 1 | 2): [number, number] => [
    handleTime((xs[index] - xs[0]) / width),
    handleWay((ys[index] - ys[0]) / height),
  ];
  return [...scaled(1), ...scaled(2)];
}

const LEAST = 1e-6;

type Four = readonly [number, number, number, number];

function split([a, b, c, d]: Four, t: number): Readonly<Record<'before' | 'behind', Four>> {
  const mid = (one: number, other: number): number => one + (other - one) * t;
  const [ab, bc, cd] = [mid(a, b), mid(b, c), mid(c, d)];
  const [abc, bcd] = [mid(ab, bc), mid(bc, cd)];
  const at = mid(abc, bcd);
  return { before: [a, ab, abc, at], behind: [at, bcd, cd, d] };
}
