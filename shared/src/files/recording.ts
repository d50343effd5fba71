// What a packet log holds, as values: what went over the link, when, and what became of the link meanwhile. Knows no text and
// no time of its own; what bytes mean is parse.ts.

import { FAMILIES, type BoardId } from '../codec/families.ts';

/** What happened beside the packets, as far as a replay has to repeat it: `stopped` by STOP on this screen, `latched` otherwise. */
export const HAPPENINGS = ['opened', 'lost', 'closed', 'stopped', 'latched', 'resumed'] as const;
export type Happening = (typeof HAPPENINGS)[number];

/** Bytes that are no packet are kept apart as the decoder told them: `garbage`, or `truncated` by a silence. */
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

export function isBoardId(text: string): text is BoardId {
  return text === 'unknown' || Object.hasOwn(FAMILIES, text);
}

export function isHappening(text: string): text is Happening {
  return (HAPPENINGS as readonly string[]).includes(text);
}
