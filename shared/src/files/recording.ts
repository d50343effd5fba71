// What a packet log holds, as values: what went over the link, when, and what became of the link meanwhile; and each entry as one
// line that a person can read and edit: `12.345  >  55 55 02 0F  # Ask for the battery`. Knows no file and no time of its own.

import type { BoardId } from '../codec/families.ts';
import { toHex } from '../codec/packet.ts';

/** What happened beside the packets, as far as a replay has to repeat it: `stopped` by STOP on this screen, `latched` otherwise. */
export const HAPPENINGS = ['opened', 'lost', 'closed', 'stopped', 'latched', 'resumed'] as const;
export type Happening = (typeof HAPPENINGS)[number];

/** Bytes that are no packet are stored apart, as the decoder reported them: `garbage`, or `truncated` by a silence. */
export type ByteMark = 'sent' | 'received' | 'garbage' | 'truncated';

/** `atMs` on the clock of the session, in whole milliseconds. */
export type Entry = { readonly atMs: number } & (
  | { readonly mark: ByteMark; readonly bytes: Uint8Array }
  | { readonly mark: 'link'; readonly happening: Happening }
  /** From here on the bytes belong to a board of another family. */
  | { readonly mark: 'board'; readonly board: BoardId }
);

export interface Header {
  /** The family of the first entry. */
  readonly board: BoardId;
  /** The port, for people. */
  readonly port: string;
  /** When it was saved, ISO 8601. */
  readonly date: string;
  /** Version of the program that wrote it. */
  readonly app: string;
  /** What a replay must come to: lines of `replayFacts`. */
  readonly expectations: readonly string[];
}

export interface Recording {
  readonly header: Header;
  readonly entries: readonly Entry[];
}

export const SIGNS: Readonly<Record<ByteMark, string>> = {
  sent: '>',
  received: '<',
  garbage: '<?',
  truncated: '<|',
};
export const EVENT_SIGN = '=';
/** Without words for people. */
export function writeLine(entry: Entry): string {
  const seconds = (entry.atMs / 1000).toFixed(3);
  if (entry.mark === 'link') return [seconds, EVENT_SIGN, entry.happening].join('  ');
  if (entry.mark === 'board') return [seconds, EVENT_SIGN, `board ${entry.board}`].join('  ');
  return [seconds, SIGNS[entry.mark], toHex(entry.bytes)].join('  ');
}
