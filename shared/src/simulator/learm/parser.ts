// LeArm's byte parser (L3): no time-out, numbers from 26 on refused, a buffer of 60 bytes that is filled without looking.
// Knows bytes only. What the real one does to its memory then is not imitated: it says `overrun` and the board jams.

import { HEADER } from '../../codec/packet.ts';

export interface ParserEvents {
  readonly complete: (command: number, params: Uint8Array) => void;
  /** A byte was written behind the end of the buffer. */
  readonly overrun: () => void;
}

const BUFFER_BYTES = 60;
const FIRST_REFUSED = 26;
const BARE_LENGTH = 2;

export function createLearmParser({ complete, overrun }: ParserEvents): (byte: number) => void {
  let take = hunt();

  type State = (byte: number) => State;

  function hunt(headersSeen = 0): State {
    if (headersSeen === 2) return length;
    return (byte) => hunt(byte === HEADER ? headersSeen + 1 : 0);
  }

  function length(byte: number): State {
    return byte === 0 ? hunt() : (next) => command(byte, next);
  }

  function command(len: number, byte: number): State {
    if (len === BARE_LENGTH) {
      complete(byte, new Uint8Array());
      return hunt();
    }
    // LEN 1 cannot be, yet it waits for a byte.
    return byte >= FIRST_REFUSED ? hunt() : data(byte, Math.max(len - BARE_LENGTH, 1), []);
  }

  function data(number: number, wanted: number, params: number[]): State {
    return (byte) => {
      params.push(byte);
      if (params.length > BUFFER_BYTES) {
        overrun();
        return hunt();
      }
      if (params.length < wanted) return data(number, wanted, params);
      complete(number, Uint8Array.from(params));
      return hunt();
    };
  }

  return (byte) => void (take = take(byte));
}
