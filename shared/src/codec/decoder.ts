// Bytes in, packets and noise out, whatever pieces the bytes come in and however damaged they are. Bounded memory, never
// throws. Knows no meaning, no family and no time: the caller says with `pause` and `idle` that the line has been silent
// for longer than bytes of one packet usually are apart (20 ms), or ever are (60 ms covers every adapter).

import timings from '../../protocol/timings.json' with { type: 'json' };
import { judge, judgeLast, NO, WAIT, REPORT_SHAPES, type ShapeRule } from './shapes.ts';
import { HEADER, type Packet } from './packet.ts';

export type DecoderEvent =
  | { readonly kind: 'packet'; readonly packet: Packet; readonly bytes: Uint8Array }
  /** `garbage` belongs to no packet; `truncated` began like one that the silence cut short. */
  | { readonly kind: 'noise'; readonly reason: 'garbage' | 'truncated'; readonly bytes: Uint8Array };

interface Decoder {
  push(bytes: Uint8Array): void;
  /** The line has paused for longer than its bytes are apart, yet may go on: what is complete is believed, half packets wait. */
  pause(): void;
  /** The line is silent: what is complete is believed, the rest is noise. Harmless at any time. */
  idle(): void;
  /** Forgets everything, silently: a new connection. */
  reset(): void;
}

/** The longest packet, 255 bytes, and the four after it that can be needed to judge it fit several times over. */
const CARRY_SIZE = 384;
/** How much of a new chunk is copied behind carried bytes at a time. */
const CARRY_STEP = 64;
const NOISE_SIZE = timings.decoder.noiseBytes;
/** Up to about this many bytes a loop copies faster than `slice`; a reply has 4 to 7, a stored frame 28. */
const LOOP_SIZE = 16;
const NO_PARAMS = new Uint8Array(0);

export function createDecoder(
  emit: (event: DecoderEvent) => void,
  shape: ShapeRule = REPORT_SHAPES,
): Decoder {
  /** Bytes of earlier chunks that could not be judged yet. */
  const carry = new Uint8Array(CARRY_SIZE);
  let carried = 0;
  const noise = new Uint8Array(NOISE_SIZE);
  let noiseCount = 0;

  function emitNoise(): void {
    if (noiseCount === 0) return;
    const bytes = noise.slice(0, noiseCount);
    noiseCount = 0;
    emit({ kind: 'noise', reason: 'garbage', bytes });
  }

  function emitPacket(source: Uint8Array, from: number, to: number): void {
    emitNoise();
    const bytes = copy(source, from, to);
    // Two small arrays are three times as fast as one and a view on it, which would move its buffer out of the heap.
    const params = bytes.length === 4 ? NO_PARAMS : copy(source, from + 4, to);
    emit({ kind: 'packet', packet: { command: bytes[3] ?? 0, params }, bytes });
  }

  /** Drops the byte at `at` and all behind it that cannot begin a packet. Returns where it stopped. */
  function drop(bytes: Uint8Array, at: number, end: number): number {
    let next = at;
    do {
      noise[noiseCount++] = bytes[next++] ?? 0;
      if (noiseCount === NOISE_SIZE) emitNoise();
    } while (next < end && bytes[next] !== HEADER);
    return next;
  }

  /** Reads bytes from `from` until `until` is reached or passed, or more than `end` is needed. Returns where it stopped. */
  function read(bytes: Uint8Array, from: number, until: number, end: number): number {
    let at = from;
    while (at < until) {
      const size = judge(shape, bytes, at, end);
      if (size === WAIT) return at;
      if (size === NO) {
        at = drop(bytes, at, end);
      } else {
        emitPacket(bytes, at, at + size);
        at += size;
      }
    }
    return at;
  }

  /** Settles what is carried with the chunk's first bytes. Returns how many of them are done with. */
  function readCarried(chunk: Uint8Array): number {
    let taken = 0;
    while (carried > 0 && taken < chunk.length) {
      const before = carried;
      const end = before + Math.min(CARRY_STEP, chunk.length - taken);
      append(carry, before, chunk, taken, taken + end - before);
      const stop = read(carry, 0, before, end);
      if (stop >= before) {
        taken += stop - before;
        carried = 0;
      } else {
        taken += end - before;
        carry.copyWithin(0, stop, end);
        carried = end - stop;
      }
    }
    return taken;
  }

  function push(chunk: Uint8Array): void {
    const from = carried > 0 ? readCarried(chunk) : 0;
    if (carried > 0) return;
    const stop = read(chunk, from, chunk.length, chunk.length);
    append(carry, 0, chunk, stop, chunk.length);
    carried = chunk.length - stop;
  }

  /** Emits what began like a packet at `from` and never ended, up to the next whole packet. Returns where that is. */
  function emitTruncated(from: number): number {
    let to = from + 1;
    while (to < carried && judgeLast(shape, carry, to, carried) <= 0) to++;
    emitNoise();
    emit({ kind: 'noise', reason: 'truncated', bytes: carry.slice(from, to) });
    return to;
  }

  function pause(): void {
    let at = 0;
    for (
      let size = judgeLast(shape, carry, 0, carried);
      size > 0;
      size = judgeLast(shape, carry, at, carried)
    ) {
      emitPacket(carry, at, at + size);
      at += size;
      if (at === carried) break;
    }
    carry.copyWithin(0, at, carried);
    carried -= at;
  }

  function idle(): void {
    let at = 0;
    while (at < carried) {
      const size = judgeLast(shape, carry, at, carried);
      if (size > 0) {
        emitPacket(carry, at, at + size);
        at += size;
      } else if (size === WAIT && at + 1 < carried) {
        at = emitTruncated(at);
      } else {
        at = drop(carry, at, carried); // a single header byte at the end says nothing either
      }
    }
    carried = 0;
    emitNoise();
  }

  function reset(): void {
    carried = 0;
    noiseCount = 0;
  }

  return { push, pause, idle, reset };
}

function copy(source: Uint8Array, from: number, to: number): Uint8Array {
  if (to - from > LOOP_SIZE) return source.slice(from, to);
  const bytes = new Uint8Array(to - from);
  append(bytes, 0, source, from, to);
  return bytes;
}

/** A plain loop: for the few bytes of a packet it is faster than making a view for `set`. */
function append(target: Uint8Array, at: number, source: Uint8Array, from: number, to: number): void {
  for (let i = from; i < to; i++) target[at + i - from] = source[i] ?? 0;
}
