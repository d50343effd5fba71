// The worker beside the page that listens to a sound: how loud each moment of it is, and its beats. Knows no file and no group.

import { type Beats, findBeats } from '#shared/group/beats.ts';

export interface Samples {
  readonly samples: Float32Array<ArrayBuffer>;
  readonly sampleRate: number;
}

export interface Heard {
  /** The loudest sample of each `peakMs`, from 0 to 1. */
  readonly peaks: Float32Array<ArrayBuffer>;
  readonly peakMs: number;
  /** null: none were found. */
  readonly beats: Beats | null;
}

const PEAK_MS = 5;

function peaksOf({ samples, sampleRate }: Samples): Float32Array<ArrayBuffer> {
  const perPeak = (sampleRate * PEAK_MS) / 1000;
  const peaks = new Float32Array(Math.ceil(samples.length / perPeak));
  for (const [at, sample] of samples.entries()) {
    const peak = Math.floor(at / perPeak);
    peaks[peak] = Math.max(peaks[peak] ?? 0, Math.abs(sample));
  }
  return peaks;
}

addEventListener('message', ({ data }: MessageEvent<Samples>) => {
  const peaks = peaksOf(data);
  const beats = findBeats(data.samples, data.sampleRate);
  postMessage({ peaks, peakMs: PEAK_MS, beats } satisfies Heard, { transfer: [peaks.buffer] });
});
