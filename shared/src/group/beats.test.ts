import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { evenly } from '../testing/cases.ts';
import { beatNear, bpmOf, findBeats, nearestBeat, tappedBeats, withTempo } from './beats.ts';

const RATE = 8000;
const LENGTH_MS = 60_000;

interface Track {
  readonly bpm: number;
  readonly firstMs: number;
  /** Loudness of what is between two beats, beside that of a beat. */
  readonly offBeat: number;
  /** Where between two beats: a half is straight, two thirds are swing. */
  readonly swing: number;
  readonly noise: number;
  /** How much quieter the quietest part is than the loudest. */
  readonly fade: number;
  readonly seed: number;
}

const tracks: fc.Arbitrary<Track> = fc.record({
  bpm: evenly(60, 200),
  firstMs: evenly(0, 900),
  offBeat: evenly(0, 0.4),
  swing: evenly(0.5, 0.67),
  noise: evenly(0, 0.05),
  fade: evenly(0, 0.8),
  seed: fc.integer({ min: 1, max: 1_000_000 }),
});

/** Between -1 and 1, the same for the same seed. */
function noiseOf(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1_664_525) + 1_013_904_223) | 0;
    return state / 0x8000_0000;
  };
}

function put(samples: Float32Array, atMs: number, loudness: number, noise: () => number): void {
  const from = Math.round((atMs * RATE) / 1000);
  for (let at = 0; at < RATE * 0.05 && from + at < samples.length; at += 1)
    samples[from + at] = (samples[from + at] ?? 0) + loudness * noise() * Math.exp((-at / RATE) * 80);
}

function played({ bpm, firstMs, offBeat, swing, noise: hiss, fade, seed }: Track): Float32Array {
  const samples = new Float32Array((RATE * LENGTH_MS) / 1000);
  const noise = noiseOf(seed);
  const everyMs = 60_000 / bpm;
  const loudnessAt = (atMs: number): number => 1 - (fade * (1 + Math.cos(atMs / 5000))) / 2;
  for (let atMs = firstMs; atMs < LENGTH_MS; atMs += everyMs) {
    put(samples, atMs, loudnessAt(atMs), noise);
    put(samples, atMs + everyMs * swing, loudnessAt(atMs) * offBeat, noise);
  }
  return samples.map((one) => one + hiss * noise());
}

/** Syllables of a tone, none of them in time, with pauses between sentences. */
function speech(seed: number): Float32Array {
  const samples = new Float32Array((RATE * LENGTH_MS) / 1000);
  const noise = noiseOf(seed);
  for (let atMs = 0, word = 1; atMs < LENGTH_MS; word += 1) {
    const lengthMs = 200 + 120 * noise();
    const hz = 150 + 60 * noise();
    const [from, to] = [atMs, atMs + lengthMs].map((one) => Math.round((one * RATE) / 1000)) as [
      number,
      number,
    ];
    for (let at = from; at < Math.min(to, samples.length); at += 1)
      samples[at] =
        0.4 * Math.sin((Math.PI * (at - from)) / (to - from)) * Math.sin((2 * Math.PI * hz * at) / RATE);
    atMs += lengthMs + (word % 7 === 0 ? 500 + 300 * noise() : 40 + 30 * noise());
  }
  return samples;
}

describe('the beats of a track', () => {
  test('have its tempo within 1 %, and none is off by more than 20 ms over a minute', () => {
    fc.assert(
      fc.property(tracks, (track) => {
        const found = findBeats(played(track), RATE);
        if (found === null) throw new Error('no beat was found');
        expect(Math.abs(bpmOf(found) / track.bpm - 1)).toBeLessThan(0.01);
        for (let atMs = track.firstMs; atMs < LENGTH_MS; atMs += 60_000 / track.bpm)
          expect(Math.abs(nearestBeat(found, atMs).atMs - atMs)).toBeLessThan(20);
      }),
      { numRuns: 60 },
    );
  });

  test('are none in silence, in noise, in speech and in a sound of a second', () => {
    expect(findBeats(new Float32Array(RATE * 20), RATE)).toBeNull();
    expect(findBeats(new Float32Array(0), RATE)).toBeNull();
    const metronome = played({ bpm: 120, firstMs: 0, offBeat: 0, swing: 0.5, noise: 0, fade: 0, seed: 1 });
    expect(findBeats(metronome.slice(0, RATE), RATE)).toBeNull();
    fc.assert(
      fc.property(fc.integer({ min: 1, max: 1_000_000 }), (seed) => {
        const noise = noiseOf(seed);
        expect(findBeats(new Float32Array(RATE * 20).map(noise), RATE)).toBeNull();
        expect(findBeats(speech(seed), RATE)).toBeNull();
        expect(findBeats(speech(seed).slice(0, RATE * 6), RATE)).toBeNull();
      }),
      { numRuns: 40 },
    );
  });
});

test('taps give the tempo and the first beat, whatever is missed between them', () => {
  const taps = fc.record({
    everyMs: evenly(300, 1000),
    firstMs: evenly(20, 2000),
    early: fc.array(evenly(-15, 15), { minLength: 4, maxLength: 30 }),
    missed: fc.integer({ min: 2, max: 40 }),
  });
  fc.assert(
    fc.property(taps, ({ everyMs, firstMs, early, missed }) => {
      const tapped = early
        .map((byMs, index) => firstMs + index * everyMs + byMs)
        .filter((_, index) => index !== missed || early.length < 6);
      const found = tappedBeats(tapped);
      if (found === null) throw new Error('no beat was found');
      for (const atMs of tapped) expect(Math.abs(nearestBeat(found, atMs).atMs - atMs)).toBeLessThan(31);
      expect(found.firstMs).toBeLessThan(found.everyMs + 1);
    }),
  );
  expect(tappedBeats([0, 500, 1000, 2000, 2500])).toEqual({ firstMs: 0, everyMs: 500 });
  expect(tappedBeats([0, 500, 1000])).toBeNull();
  expect(tappedBeats([0, 20, 40, 60])).toBeNull();
  expect(tappedBeats([0, 5000, 10_000, 15_000])).toBeNull();
});

test('half the tempo has every other beat, twice the tempo one more between two', () => {
  const beats = { firstMs: 400, everyMs: 500 };
  expect(withTempo(beats, 0.5)).toEqual({ firstMs: 400, everyMs: 1000 });
  expect(withTempo(beats, 2)).toEqual({ firstMs: 150, everyMs: 250 });
  expect(withTempo({ firstMs: 0, everyMs: 150 }, 2)).toBeNull();
  expect(withTempo({ firstMs: 0, everyMs: 3000 }, 0.5)).toBeNull();
  expect(nearestBeat(beats, 1160)).toEqual({ number: 2, atMs: 1400 });
  expect(nearestBeat(beats, -900)).toEqual({ number: 0, atMs: 400 });
});

test('the beats of a group go along with its sound', () => {
  const sound = {
    id: '0123456789abcdef',
    fileName: 'march.ogg',
    startMs: -100,
    beats: { firstMs: 400, everyMs: 500.4 },
  };
  expect(beatNear(sound, 850)).toEqual({ number: 1, atMs: 800 });
  expect(beatNear(sound, -2000)).toEqual({ number: 0, atMs: 300 });
  expect(beatNear({ ...sound, beats: null }, 850)).toBeNull();
  expect(beatNear(undefined, 850)).toBeNull();
});
