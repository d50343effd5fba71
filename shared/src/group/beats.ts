// Beats of a sound: found in its samples, fitted to taps, and counted. Times are in ms since the sound began; a beat grid has one tempo from
// beginning to end. Pure; knows no file, no player and no screen.

import { FASTEST_BEAT_MS, type GroupSound, SLOWEST_BEAT_MS } from './group.ts';

/** Beat number n, from 0, is at firstMs + n × everyMs. */
export interface Beats {
  readonly firstMs: number;
  readonly everyMs: number;
}

/** Of the beats that are found in samples. */
const TEMPO_BPM = { min: 60, max: 200 } as const;
const MINUTE_MS = 60_000;

export const bpmOf = ({ everyMs }: Beats): number => MINUTE_MS / everyMs;

/** The same grid with its first beat as early in the sound as can be. */
function normalized(atMs: number, everyMs: number): Beats {
  const firstMs = atMs - Math.floor(atMs / everyMs) * everyMs;
  return { firstMs: rounded(firstMs, 10), everyMs: rounded(everyMs, 1000) };
}

/** Fractions of a ms that matter: over a thousand beats a thousandth of a ms is a whole one. */
const rounded = (value: number, parts: number): number => Math.round(value * parts) / parts;

/** Half or twice as many beats, the first one where it was; null: slower or faster than a group takes. */
export function withTempo({ firstMs, everyMs }: Beats, factor: 0.5 | 2): Beats | null {
  const next = everyMs / factor;
  return next < FASTEST_BEAT_MS || next > SLOWEST_BEAT_MS ? null : normalized(firstMs, next);
}

/** The beat that is nearest to an instant; none before the first one. */
export function nearestBeat({ firstMs, everyMs }: Beats, atMs: number): { number: number; atMs: number } {
  const number = Math.max(0, Math.round((atMs - firstMs) / everyMs));
  return { number, atMs: firstMs + number * everyMs };
}

/** In ms of the group, whole ones as its frames; null: it has no sound, or that no beats. */
export function beatNear(
  sound: GroupSound | undefined,
  atMs: number,
): { number: number; atMs: number } | null {
  if (!sound?.beats) return null;
  const { startMs, beats } = sound;
  const beat = nearestBeat(beats, atMs - startMs);
  return { ...beat, atMs: Math.round(beat.atMs + startMs) };
}

// Taps: a straight line through them by least squares. A pause or a missed tap leaves a gap in the numbers, not in the tempo.

const FEWEST_TAPS = 4;

/** null: too few taps, or slower or faster than a person taps. */
export function tappedBeats(tapsMs: readonly number[]): Beats | null {
  const steps = tapsMs.slice(1).map((atMs, index) => atMs - (tapsMs[index] ?? 0));
  const usual = steps.toSorted((one, other) => one - other)[Math.floor(steps.length / 2)];
  if (tapsMs.length < FEWEST_TAPS || usual === undefined) return null;
  if (usual < FASTEST_BEAT_MS || usual > SLOWEST_BEAT_MS) return null;
  let number = 0;
  const points = tapsMs.map((atMs, index) => {
    if (index > 0) number += Math.max(1, Math.round((steps[index - 1] ?? 0) / usual));
    return { x: number, y: atMs, weight: 1 };
  });
  const { at, slope } = lineThrough(points);
  return normalized(at, slope);
}

interface Point {
  readonly x: number;
  readonly y: number;
  readonly weight: number;
}

function lineThrough(points: readonly Point[]): { readonly at: number; readonly slope: number } {
  const sum = (of: (point: Point) => number): number =>
    points.reduce((total, point) => total + point.weight * of(point), 0);
  const weight = sum(() => 1);
  const [x, y] = [sum((point) => point.x) / weight, sum((point) => point.y) / weight];
  const spread = sum((point) => (point.x - x) ** 2);
  const slope = sum((point) => (point.x - x) * (point.y - y)) / spread;
  return { at: y - slope * x, slope };
}

// Onsets: how much louder each moment is than the one before, in three bands, so that a drum is heard beside a voice.

/** A beat is placed to a fraction of this. */
const HOP_MS = 5;
const BANDS_HZ = [200, 2000] as const;
/** Loudness is measured against that of some seconds around: a quiet part counts as much as a loud one. */
const AROUND_HOPS = 600;
/** Of the loudest moment: below it there is silence, and noise of a recorder. */
const SILENCE = 1e-3;

/** One number a hop. */
function onsetsOf(samples: Float32Array, sampleRate: number): Float32Array {
  const perHop = (sampleRate * HOP_MS) / 1000;
  const count = Math.floor(samples.length / perHop);
  const onsets = new Float32Array(count);
  for (const band of loudnessOfBands(samples, perHop, count, sampleRate)) {
    const loudest = band.reduce((most, one) => Math.max(most, one), 0);
    if (loudest === 0) continue;
    const usual = meansAround(band);
    for (let hop = 2; hop < count; hop += 1) {
      const floor = (usual[hop] ?? 0) + loudest * SILENCE;
      const before = Math.max(band[hop - 1] ?? 0, band[hop - 2] ?? 0);
      onsets[hop] = (onsets[hop] ?? 0) + Math.min(LOUD, Math.max(0, (band[hop] ?? 0) - before) / floor);
    }
  }
  return onsets;
}

/** One single bang shall not outweigh a bar. */
const LOUD = 8;

/** Root mean squares: low, middle and high, split by filters of the first order, twice each. */
function loudnessOfBands(
  samples: Float32Array,
  perHop: number,
  count: number,
  sampleRate: number,
): readonly Float32Array[] {
  const [lowShare, highShare] = BANDS_HZ.map((hz) => 1 - Math.exp((-2 * Math.PI * hz) / sampleRate)) as [
    number,
    number,
  ];
  const bands = [0, 1, 2].map(() => new Float32Array(count)) as [Float32Array, Float32Array, Float32Array];
  let [low, lower, high, higher, at] = [0, 0, 0, 0, 0];
  for (let hop = 0; hop < count; hop += 1) {
    const [from, to] = [at, Math.floor((hop + 1) * perHop)];
    let [lows, middles, highs] = [0, 0, 0];
    for (; at < to; at += 1) {
      const sample = samples[at] ?? 0;
      low += lowShare * (sample - low);
      lower += lowShare * (low - lower);
      high += highShare * (sample - high);
      higher += highShare * (high - higher);
      lows += lower ** 2;
      middles += (higher - lower) ** 2;
      highs += (sample - higher) ** 2;
    }
    [lows, middles, highs].forEach((sum, band) => {
      bands[band as 0 | 1 | 2][hop] = Math.sqrt(sum / (to - from));
    });
  }
  return bands;
}

function meansAround(band: Float32Array): Float32Array {
  const sums = new Float64Array(band.length + 1);
  band.forEach((one, hop) => (sums[hop + 1] = (sums[hop] ?? 0) + one));
  return band.map((_, hop) => {
    const [from, to] = [Math.max(0, hop - AROUND_HOPS), Math.min(band.length, hop + AROUND_HOPS)];
    return ((sums[to] ?? 0) - (sums[from] ?? 0)) / (to - from);
  });
}

// Tempo: at which lag the onsets are most like themselves, first roughly, then at ever longer lags.

const LAGS = {
  from: Math.floor(MINUTE_MS / TEMPO_BPM.max / HOP_MS) - 1,
  to: Math.ceil(MINUTE_MS / TEMPO_BPM.min / HOP_MS) + 1,
};
/** A shorter lag that is nearly as good is the beat, and the longer one a bar. */
const NEARLY = 0.85;
/** Tempi far from this are less likely: by octaves. */
const USUAL_BPM = 120;
const OCTAVES = 2;

function likeness(onsets: Float32Array, lag: number): number {
  let sum = 0;
  for (let hop = lag; hop < onsets.length; hop += 1) sum += (onsets[hop] ?? 0) * (onsets[hop - lag] ?? 0);
  return sum / (onsets.length - lag);
}

/** A beat that lies between two hops shall be as like the next one as one that lies on a hop. */
const WIDE = [1, 2, 3, 2, 1];

const widened = (onsets: Float32Array): Float32Array =>
  onsets.map((_, hop) => WIDE.reduce((sum, share, by) => sum + share * (onsets[hop + by - 2] ?? 0), 0));

/** In hops. `onsets` are widened. */
function periodOf(onsets: Float32Array): number | null {
  const scores: { readonly lag: number; readonly score: number }[] = [];
  for (let lag = LAGS.from; lag <= LAGS.to; lag += 1) {
    const octaves = Math.log2(MINUTE_MS / (lag * HOP_MS) / USUAL_BPM);
    scores.push({ lag, score: likeness(onsets, lag) * Math.exp(-0.5 * (octaves / OCTAVES) ** 2) });
  }
  const best = Math.max(...scores.map(({ score }) => score));
  const first = scores.findIndex(({ score }) => score >= best * NEARLY);
  if (best <= 0 || first === -1) return null;
  const peak = scores.slice(first, first + 4).reduce((most, one) => (one.score > most.score ? one : most));
  let period = peak.lag;
  for (let beats = 2; beats * period < onsets.length / 2; beats *= 2) {
    const reach = Math.max(2, Math.ceil(beats / 2));
    period = bestLag(onsets, beats * period, Math.min(reach, 4)) / beats;
  }
  return period;
}

/** Between hops: where a parabola through the best one and its neighbours has its top. */
function bestLag(onsets: Float32Array, around: number, reach: number): number {
  const from = Math.round(around) - reach;
  const values = Array.from({ length: 2 * reach + 1 }, (_, index) => likeness(onsets, from + index));
  const top = values.indexOf(Math.max(...values));
  const [before = 0, at = 0, after = 0] = [values[top - 1], values[top], values[top + 1]];
  const bend = before - 2 * at + after;
  const isInside = top > 0 && top < values.length - 1 && bend < 0;
  return from + top + (isInside ? (before - after) / (2 * bend) : 0);
}

// Phase: where in the period most onsets are; then a line through the strongest onset near each beat.

/** How far an onset may be from its beat to count for it. */
const REACH_HOPS = 6;
const PHASES = 100;
const FITS = 3;

function phaseOf(onsets: Float32Array, period: number): number {
  const bins = new Float32Array(PHASES);
  onsets.forEach((one, hop) => {
    const bin = Math.floor(((hop / period) % 1) * PHASES);
    bins[bin] = (bins[bin] ?? 0) + one;
  });
  const wide = Math.max(1, Math.round((2 / period) * PHASES));
  const around = (bin: number): number => {
    let sum = 0;
    for (let by = -wide; by <= wide; by += 1) sum += bins[(bin + by + PHASES) % PHASES] ?? 0;
    return sum;
  };
  const sums = Array.from(bins, (_, bin) => around(bin));
  return ((sums.indexOf(Math.max(...sums)) + 0.5) / PHASES) * period;
}

interface Grid {
  readonly at: number;
  readonly slope: number;
}

function fitted(onsets: Float32Array, grid: Grid): Grid {
  const points: Point[] = [];
  const count = Math.floor((onsets.length - grid.at) / grid.slope);
  for (let beat = 0; beat <= count; beat += 1) {
    const middle = Math.round(grid.at + beat * grid.slope);
    let [weight, sum] = [0, 0];
    for (let hop = Math.max(0, middle - REACH_HOPS); hop <= middle + REACH_HOPS; hop += 1) {
      const one = (onsets[hop] ?? 0) ** 2;
      weight += one;
      sum += one * hop;
    }
    if (weight > 0) points.push({ x: beat, y: sum / weight, weight: Math.sqrt(weight) });
  }
  const next = points.length < 2 ? grid : lineThrough(points);
  return Number.isFinite(next.slope) ? next : grid;
}

// Whether it is a beat at all: how much more of the onsets is on it than chance would put there.

const LEAST_SHARE = 0.25;
const DEVIATIONS = 6;
/** Shorter sounds are no music. */
const SHORTEST_HOPS = 1000;

function isBeat(onsets: Float32Array, { at, slope }: Grid): boolean {
  let [near, all, squares] = [0, 0, 0];
  onsets.forEach((one, hop) => {
    const beats = (hop - at) / slope;
    if (Math.abs(beats - Math.round(beats)) * slope <= REACH_HOPS) near += one;
    all += one;
    squares += one ** 2;
  });
  if (all === 0) return false;
  const byChance = (2 * REACH_HOPS + 1) / slope;
  const deviation = Math.sqrt((byChance * (1 - byChance) * squares) / all ** 2);
  const more = near / all - byChance;
  return more >= LEAST_SHARE && more >= DEVIATIONS * deviation;
}

/** `samples` of one channel, from −1 to 1. null: no steady beat in it. */
export function findBeats(samples: Float32Array, sampleRate: number): Beats | null {
  const onsets = onsetsOf(samples, sampleRate);
  const period = onsets.length < SHORTEST_HOPS ? null : periodOf(widened(onsets));
  if (period === null) return null;
  let grid: Grid = { at: phaseOf(onsets, period), slope: period };
  for (let fit = 0; fit < FITS; fit += 1) grid = fitted(onsets, grid);
  if (!isBeat(onsets, grid)) return null;
  // An onset is somewhere within its hop.
  return normalized((grid.at + 0.5) * HOP_MS, grid.slope * HOP_MS);
}
