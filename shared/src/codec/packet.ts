// One unit on the wire: `55 55 LEN CMD …`. LEN counts itself and CMD, so a packet is LEN + 2 bytes; there is no checksum and no
// escape. Its bytes as people write them. Knows bytes only: no command's meaning, no board, no time.

import timings from '../../protocol/timings.json' with { type: 'json' };

export interface Packet {
  /** CMD, 0..255. */
  readonly command: number;
  /** The bytes after CMD, 0..251 of them. */
  readonly params: Uint8Array;
}

export const HEADER = 0x55;
/** Largest LEN a board's parser can take; 254 and 255 jam it for good (S3). */
export const MAX_LENGTH = 253;
export const MIN_LENGTH = 2;
export const BAUD = timings.line.baud;

/** The packet's bytes. Throws RangeError where the parameters do not fit LEN ≤ 253 or the command is no byte. */
export function packetBytes(command: number, params: Uint8Array | readonly number[]): Uint8Array {
  const length = params.length + MIN_LENGTH;
  if (length > MAX_LENGTH) throw new RangeError(`LEN ${length} is larger than ${MAX_LENGTH}`);
  if (!Number.isInteger(command) || command < 0 || command > 0xff) {
    throw new RangeError(`command ${command} is not a byte`);
  }
  const bytes = new Uint8Array(length + 2);
  bytes[0] = HEADER;
  bytes[1] = HEADER;
  bytes[2] = length;
  bytes[3] = command;
  bytes.set(params, 4);
  return bytes;
}

/** Milliseconds that `byteCount` bytes spend on the wire at `baud`. */
export function wireMs(byteCount: number, baud = BAUD): number {
  return (byteCount * 10_000) / baud;
}

const PAIRS = Array.from({ length: 256 }, (_, byte) => byte.toString(16).toUpperCase().padStart(2, '0'));

/** Upper case, one space between bytes; the empty string for no bytes. */
export function toHex(bytes: Uint8Array): string {
  return Array.from(bytes, (byte) => PAIRS[byte]).join(' ');
}

/** Any case, white space optional between bytes. Throws SyntaxError on anything that is not whole bytes. */
export function fromHex(text: string): Uint8Array {
  if (!/^\s*([0-9a-f]{2}\s*)*$/i.test(text)) throw new SyntaxError(`not hexadecimal bytes: ${text}`);
  const digits = text.replace(/\s+/g, '');
  const bytes = new Uint8Array(digits.length / 2);
  for (let i = 0; i < bytes.length; i++) bytes[i] = parseInt(digits.slice(2 * i, 2 * i + 2), 16);
  return bytes;
}

export const moveBytes = (servoCount: number): number => 7 + 3 * servoCount;

/** As many servos as a move of that length names. */
export const servosIn = (bytes: number): number => Math.floor((bytes - moveBytes(0)) / 3);
