// Decides whether a packet begins at a place in a run of bytes: yes, no, or "more bytes needed". Pure; keeps nothing and
// knows no chunks. The wire has no checksum, so a packet has to prove itself by its shape and by what follows it.

import { HEADER } from './packet.ts';
import type { ShapeRule } from './shapes.ts';

/** No packet begins here. */
export const NO = -1;
/** The bytes end before it can be told. */
export const WAIT = 0;
/** Two headers, LEN, CMD: a packet without parameters is no longer. */
const HEAD_SIZE = 4;

/**
 * The size of the packet at `at`, NO or WAIT. An empty packet is believed at once, unless its number equals its LEN: that
 * may be any packet whose LEN was doubled. Such a one and a packet with parameters are believed when the next byte begins
 * another packet: one byte too few or too many inside it shows there, and only there.
 * The answer never depends on bytes beyond those that settle it, so it is the same however the bytes arrive.
 */
export function judge(shape: ShapeRule, bytes: Uint8Array, at: number, end: number): number {
  const size = packetSize(shape, bytes, at, end);
  if (size < HEAD_SIZE || (size === HEAD_SIZE && bytes[at + 3] !== bytes[at + 2])) return size;
  return at + size > end ? WAIT : followed(shape, bytes, at, size, end);
}

/** Like `judge` where nothing more will come: what is complete is believed, WAIT means cut short. */
export function judgeLast(shape: ShapeRule, bytes: Uint8Array, at: number, end: number): number {
  const verdict = judge(shape, bytes, at, end);
  if (verdict !== WAIT) return verdict;
  const size = packetSize(shape, bytes, at, end);
  return at + size > end ? WAIT : size;
}

/** The size that the header at `at` announces, NO where it is none, WAIT while it is a header's beginning. */
function packetSize(shape: ShapeRule, bytes: Uint8Array, at: number, end: number): number {
  if (bytes[at] !== HEADER) return NO;
  if (at + 1 >= end) return WAIT;
  if (bytes[at + 1] !== HEADER) return NO;
  if (at + 2 >= end) return WAIT;
  const length = bytes[at + 2] ?? 0;
  // Also drops the first of three headers: no packet of either direction has LEN 0x55 (a board falls for it, S4).
  if (shape.lengths[length] === 0) return NO;
  if (at + 3 >= end) return WAIT;
  const command = bytes[at + 3] ?? 0;
  const count = shape.counts[(command << 8) | length] ?? 0;
  if (count === 0) return NO;
  if (count > 1) {
    const countAt = at + HEAD_SIZE + (shape.countAt[command] ?? 0);
    if (countAt < end && bytes[countAt] !== count - 2) return NO;
  }
  return length + 2;
}

/** Reads on byte by byte after a whole packet until its neighbour, or a header inside it, settles the matter. */
function followed(shape: ShapeRule, bytes: Uint8Array, at: number, size: number, end: number): number {
  const next = at + size;
  for (let seen = next + 1; seen <= end; seen++) {
    const neighbour = packetSize(shape, bytes, next, seen);
    if (neighbour === NO) return NO;
    if (neighbour > 0 || !straddled(shape, bytes, at, next, seen)) return size;
  }
  return WAIT;
}

/** Could a packet begin inside and run past `next`? Then the outer one may have lost bytes and eaten its neighbour's. */
function straddled(shape: ShapeRule, bytes: Uint8Array, at: number, next: number, seen: number): boolean {
  for (let inner = at + HEAD_SIZE; inner < next; inner++) {
    if (bytes[inner] !== HEADER) continue;
    const size = packetSize(shape, bytes, inner, seen);
    if (size === WAIT || inner + size > next) return true;
  }
  return false;
}
