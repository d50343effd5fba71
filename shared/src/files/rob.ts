// ACT-40, the .rob files of the Bus Servo Control program: a header and 248 bytes a frame with room for 40 bus servos
// (boards.md section 7). Positions are steps. The meaning of two of the three values of a servo is unknown: not read, written 0.

import type { Frame } from '../codec/commands.ts';
import { MAX_FRAMES, type ActionGroup } from '../group/group.ts';
import { Unreadable, type Drawn, type Remark } from './reading.ts';

const MAGIC = 'ACT-40';
const ENCRYPTED = 'EYPT';
const TAG_AT = 8;
const HEADER_BYTES = 16;
const FRAME_BYTES = 248;
const SLOTS_AT = 8;
const SLOT_BYTES = 6;
export const ROB_SERVOS = 40;
/** In place of a position: this servo is not used. Also the second word of each frame. */
const FILLER = 0x5555;

export const isRob = (bytes: Uint8Array): boolean => asciiAt(bytes, 0, MAGIC.length) === MAGIC;

export function readRob(bytes: Uint8Array): Drawn {
  if (bytes.length < HEADER_BYTES) throw new Unreadable('cutShort');
  refuseEncrypted(bytes);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const count = view.getUint16(MAGIC.length, true);
  if (count === 0) throw new Unreadable('noFrames');
  if (count > MAX_FRAMES) throw new Unreadable('tooManyFrames', String(count));
  const wholeFrames = Math.floor((bytes.length - HEADER_BYTES) / FRAME_BYTES);
  if (wholeFrames < count) throw new Unreadable('cutShort', String(count), { frame: wholeFrames + 1 });
  const frames = Array.from({ length: count }, (_, index) =>
    readFrame(view, HEADER_BYTES + index * FRAME_BYTES),
  );
  return { unit: 'steps', frames, remarks: behind(bytes.length - HEADER_BYTES - count * FRAME_BYTES) };
}

function refuseEncrypted(bytes: Uint8Array): void {
  const tag = asciiAt(bytes, TAG_AT, 4);
  if (tag === ENCRYPTED) throw new Unreadable('encrypted');
  if (tag !== '\0\0\0\0') throw new Unreadable('unknownTag', tag.replaceAll(/[^ -~]/g, '?'));
}

function readFrame(view: DataView, at: number): Frame {
  const slots = Array.from({ length: ROB_SERVOS }, (_, slot) => ({
    servo: slot + 1,
    position: view.getUint16(at + SLOTS_AT + slot * SLOT_BYTES, true),
  }));
  return {
    durationMs: view.getUint16(at, true),
    targets: slots.filter(({ position }) => position !== FILLER),
  };
}

const behind = (count: number): readonly Remark[] =>
  count === 0 ? [] : [{ code: 'bytesBehind', place: null, found: String(count) }];

function asciiAt(bytes: Uint8Array, at: number, length: number): string {
  return String.fromCharCode(...bytes.subarray(at, at + length));
}

/** Of servos 1..40; others have no place in such a file. */
export function writeRob({ frames }: ActionGroup): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(HEADER_BYTES + frames.length * FRAME_BYTES);
  const view = new DataView(bytes.buffer);
  for (let at = 0; at < MAGIC.length; at++) bytes[at] = MAGIC.charCodeAt(at);
  view.setUint16(MAGIC.length, frames.length, true);
  view.setUint16(12, 2, true);
  frames.forEach((frame, index) => writeFrame(view, HEADER_BYTES + index * FRAME_BYTES, frame));
  return bytes;
}

function writeFrame(view: DataView, at: number, { durationMs, targets }: Frame): void {
  const positions = new Map(targets.map(({ servo, position }) => [servo, position]));
  view.setUint16(at, durationMs, true);
  view.setUint16(at + 2, FILLER, true);
  for (let slot = 0; slot < ROB_SERVOS; slot++)
    view.setUint16(at + SLOTS_AT + slot * SLOT_BYTES, positions.get(slot + 1) ?? FILLER, true);
}
