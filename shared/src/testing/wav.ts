// Sounds made for tests, as files: 16 bits, one channel.

interface Metronome {
  readonly bpm: number;
  readonly firstMs: number;
  readonly lengthMs: number;
}

const RATE = 16_000;
const CLICK_MS = 30;
const HEADER_BYTES = 44;

/** A click on each beat, and silence between them. */
export function metronome({ bpm, firstMs, lengthMs }: Metronome): Uint8Array<ArrayBuffer> {
  const samples = new Int16Array((RATE * lengthMs) / 1000);
  for (let beatMs = firstMs; beatMs < lengthMs; beatMs += 60_000 / bpm) {
    const from = Math.round((beatMs * RATE) / 1000);
    for (let at = 0; at < (RATE * CLICK_MS) / 1000; at += 1)
      samples[from + at] = 24_000 * Math.cos(at * 0.9) * Math.exp(-at / 120);
  }
  return wavOf(samples);
}

function wavOf(samples: Int16Array): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(HEADER_BYTES + samples.byteLength);
  const view = new DataView(bytes.buffer);
  const text = (at: number, word: string): void =>
    bytes.set(
      Array.from(word, (letter) => letter.charCodeAt(0)),
      at,
    );
  text(0, 'RIFF');
  view.setUint32(4, bytes.length - 8, true);
  text(8, 'WAVEfmt ');
  view.setUint32(16, 16, true);
  view.setUint16(20, 1, true);
  view.setUint16(22, 1, true);
  view.setUint32(24, RATE, true);
  view.setUint32(28, RATE * 2, true);
  view.setUint16(32, 2, true);
  view.setUint16(34, 16, true);
  text(36, 'data');
  view.setUint32(40, samples.byteLength, true);
  samples.forEach((sample, index) => view.setInt16(HEADER_BYTES + index * 2, sample, true));
  return bytes;
}
