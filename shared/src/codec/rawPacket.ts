// Whether a packet written by hand may go to a board, and what it would make of it. Stricter than the board itself: it compares
// no LEN with what a command needs (S13), so that a known number in another shape acts on bytes of earlier packets (S14).
// Knows values and family rows; no link, no time.

import { COMMAND_NUMBER, type Command, type CommandKind } from './commands.ts';
import type { Family } from './families.ts';
import { checkCommand, RangeRefusal } from './encode.ts';
import { HEADER, MIN_LENGTH } from './packet.ts';
import { parseCommand } from './parse.ts';

export type RawVerdict =
  | { readonly kind: 'command'; readonly command: Command }
  /** The board has no such command and does nothing. */
  | { readonly kind: 'ignored'; readonly number: number }
  /** `missing` bytes; null before LEN says how many. */
  | { readonly kind: 'incomplete'; readonly missing: number | null }
  | { readonly kind: 'refused'; readonly reason: RawRefusal };

export type RawRefusal =
  | { readonly code: 'noHeader' }
  | { readonly code: 'shortLength' | 'longLength'; readonly length: number; readonly limit: number }
  | { readonly code: 'tooLong'; readonly extra: number }
  | { readonly code: 'neverSend' | 'unknownNumber'; readonly number: number }
  /** Written to flash, which needs the waiting and the marks of the operation itself. */
  | { readonly code: 'flash' }
  | { readonly code: 'otherShape'; readonly command: CommandKind }
  | { readonly code: 'limits'; readonly refusal: RangeRefusal };

const KINDS = new Map(Object.entries(COMMAND_NUMBER).map(([kind, number]) => [number, kind as CommandKind]));
const FLASH: readonly CommandKind[] = ['erase', 'download'];
/** Two headers and LEN, which it does not count itself. */
const UNCOUNTED = 2;

/** Judges as much as is there, so that a packet can be judged while it is being typed. */
export function judgeRaw(bytes: Uint8Array, family: Family): RawVerdict {
  const reason = headRefusal(bytes, family);
  if (reason !== null) return { kind: 'refused', reason };
  const [, , length, number] = bytes;
  if (length === undefined) return { kind: 'incomplete', missing: null };
  const missing = length + UNCOUNTED - bytes.length;
  if (missing > 0) return { kind: 'incomplete', missing };
  if (missing < 0) return { kind: 'refused', reason: { code: 'tooLong', extra: -missing } };
  return judgeWhole(number ?? 0, bytes.subarray(4), family);
}

function headRefusal(bytes: Uint8Array, family: Family): RawRefusal | null {
  const [first = HEADER, second = HEADER, length = MIN_LENGTH, number] = bytes;
  if (first !== HEADER || second !== HEADER) return { code: 'noHeader' };
  if (length < MIN_LENGTH) return { code: 'shortLength', length, limit: MIN_LENGTH };
  if (length > family.maxLength) return { code: 'longLength', length, limit: family.maxLength };
  return number === undefined ? null : numberRefusal(number, family);
}

function numberRefusal(number: number, family: Family): RawRefusal | null {
  if (family.neverSend.includes(number)) return { code: 'neverSend', number };
  const kind = kindFor(number, family);
  if (kind === null) return family.ignoresUnknown ? null : { code: 'unknownNumber', number };
  return FLASH.includes(kind) ? { code: 'flash' } : null;
}

function judgeWhole(number: number, params: Uint8Array, family: Family): RawVerdict {
  const kind = kindFor(number, family);
  if (kind === null) return { kind: 'ignored', number };
  const command = parseCommand({ command: number, params });
  if (command === null) return { kind: 'refused', reason: { code: 'otherShape', command: kind } };
  try {
    checkCommand(command, family);
    return { kind: 'command', command };
  } catch (error) {
    if (!(error instanceof RangeRefusal)) throw error;
    return { kind: 'refused', reason: { code: 'limits', refusal: error } };
  }
}

/** Null where this family has no such command, whatever others make of the number. */
function kindFor(number: number, family: Family): CommandKind | null {
  const kind = KINDS.get(number);
  return kind !== undefined && family.commands.includes(kind) ? kind : null;
}
