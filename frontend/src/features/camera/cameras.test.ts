import { expect, test } from 'vitest';
import fc from 'fast-check';
import { boundaryIn, createArrivals, createPartReader } from './cameras.ts';

const picture = fc.uint8Array({ minLength: 1, maxLength: 300 });

const bytes = (text: string): number[] => [...new TextEncoder().encode(text)];

function streamOf(pictures: readonly Uint8Array[], hasLengths: boolean): Uint8Array {
  const parts = pictures.flatMap((part) => [
    ...bytes('--frame\r\nContent-Type: image/jpeg\r\n'),
    ...bytes(hasLengths ? `Content-Length: ${part.length}\r\n` : 'X-Timestamp: 1.5\r\n'),
    ...bytes('\r\n'),
    ...part,
    ...bytes('\r\n'),
  ]);
  return new Uint8Array([...parts, ...bytes('--frame--\r\n')]);
}

function readIn(pieces: readonly Uint8Array[]): readonly number[][] {
  const reader = createPartReader('frame');
  return pieces.flatMap((piece) => reader.push(piece).map((part) => [...part]));
}

function cut(stream: Uint8Array, places: readonly number[]): readonly Uint8Array[] {
  const ends = [...places.map((place) => place % stream.length), stream.length].toSorted((a, b) => a - b);
  return ends.map((end, index) => stream.subarray(index === 0 ? 0 : ends[index - 1], end));
}

test.for([true, false])('pictures come whole, however the stream is cut (with lengths: %s)', (hasLengths) => {
  fc.assert(
    fc.property(
      fc.array(picture, { maxLength: 5 }),
      fc.array(fc.nat(), { maxLength: 9 }),
      (pictures, places) => {
        // Without lengths a picture ends before the line break of the next boundary, so it cannot hold one itself.
        const shown = hasLengths
          ? pictures
          : pictures.map((one) => one.map((byte) => (byte === 45 ? 46 : byte)));
        expect(readIn(cut(streamOf(shown, hasLengths), places))).toEqual(shown.map((one) => [...one]));
      },
    ),
  );
});

test('what is no stream of pictures ends with an error, not with full memory', () => {
  const noBoundary = createPartReader('frame');
  const mebibyte = new Uint8Array(1024 * 1024);
  expect(() => Array.from({ length: 9 }, () => noBoundary.push(mebibyte))).toThrow('no boundary');
  const large = createPartReader('frame');
  const head = new Uint8Array(bytes('--frame\r\nContent-Length: 99999999\r\n\r\n'));
  expect(() => large.push(head)).toThrow('too large');
  const endless = createPartReader('frame');
  expect(() => endless.push(new Uint8Array([...bytes('--frame\r\n'), ...new Uint8Array(5000)]))).toThrow(
    'head',
  );
});

test('the boundary is read as cameras write it', () => {
  expect(boundaryIn('multipart/x-mixed-replace; boundary=frame')).toBe('frame');
  expect(boundaryIn('multipart/x-mixed-replace;boundary=--myboundary')).toBe('myboundary');
  expect(boundaryIn('multipart/x-mixed-replace; charset=x; boundary="a b"')).toBe('a b');
  expect(boundaryIn('image/jpeg')).toBeNull();
  expect(boundaryIn('multipart/x-mixed-replace')).toBeNull();
});

test('the rate is known once it was counted for two seconds, and is no lower before', () => {
  const arrivals = createArrivals();
  expect(arrivals.figures(0)).toEqual({ rate: null, ageMs: 0 });
  for (let atMs = 10_000; atMs < 12_000; atMs += 40) {
    arrivals.note(atMs);
    expect(arrivals.figures(atMs + 15)).toEqual({ rate: null, ageMs: 15 });
  }
  arrivals.note(12_000);
  expect(arrivals.figures(12_000)).toEqual({ rate: 25, ageMs: 0 });
  expect(arrivals.figures(13_000)).toEqual({ rate: 13, ageMs: 1000 });
  expect(arrivals.figures(15_000)).toEqual({ rate: 0, ageMs: 3000 });
});
