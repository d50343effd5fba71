// The board's byte parser, with its real weaknesses: it waits for ever, never resynchronises inside a packet and jams on
// LEN 254 and 255 (S1-S5). Knows bytes only; what a packet means is dispatch.ts.

import { HEADER, MIN_LENGTH } from '../codec/packet.ts';

const BUFFER_BYTES = 256;
const LENGTH_AT = 2;

/** `complete` gets a view of the parser's buffer, valid during the call: LEN + 2 bytes. */
export function createParser(complete: (packet: Uint8Array) => void): (byte: number) => void {
  const buffer = new Uint8Array(BUFFER_BYTES).fill(HEADER, 0, LENGTH_AT);
  let headersSeen = 0;
  let index = 0;
  let length = 0;

  function hunt(byte: number): void {
    headersSeen = byte === HEADER ? headersSeen + 1 : 0;
    index = LENGTH_AT;
  }

  return (byte) => {
    if (headersSeen < 2) {
      hunt(byte);
      return;
    }
    buffer[index] = byte;
    // Also after the 8-bit index has wrapped: LEN is taken again from whatever lands here (S3).
    if (index === LENGTH_AT) length = byte;
    if (index === LENGTH_AT && length < MIN_LENGTH) {
      headersSeen = 0;
      return;
    }
    index = (index + 1) % BUFFER_BYTES;
    if (index !== length + 2) return;
    headersSeen = 0;
    complete(buffer.subarray(0, index));
  };
}
