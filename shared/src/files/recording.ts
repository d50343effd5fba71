// What a packet log holds, as values: what went over the link, when, and what became of the link meanwhile; and each entry as one
// line that a person can read and edit: `12.345  >  55 55 02 0F  # Ask for the battery`. Knows no file and no time of its own.

import { FAMILIES, type BoardId } from '../codec/families.ts';
import { fromHex, toHex } from '../codec/packet.ts';

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

export function isBoardId(text: string): text is BoardId {
  return text === 'unknown' || Object.hasOwn(FAMILIES, text);
}

function isHappening(text: string): text is Happening {
  return (HAPPENINGS as readonly string[]).includes(text);
}

const SIGNS: Readonly<Record<ByteMark, string>> = {
  sent: '>',
  received: '<',
  garbage: '<?',
  truncated: '<|',
};
const EVENT_SIGN = '=';
const MARKS: ReadonlyMap<string, ByteMark> = new Map(
  Object.entries(SIGNS).map(([mark, sign]) => [sign, mark as ByteMark]),
);
/** Longer than any packet, any piece of noise and the filler after a cut packet. */
const MAX_BYTES = 512;
/** Time, sign, the rest. */
const COLUMNS = /^(\S+)[ \t]+(\S+)(?:[ \t]+(.*))?$/u;
const SECONDS = /^\d{1,9}(?:\.\d{1,3})?$/u;

/** Says why a line cannot be read. */
export class LineProblem extends Error {
  override readonly name = 'LineProblem';
}

/** Without words for people. */
export function writeLine(entry: Entry): string {
  const seconds = (entry.atMs / 1000).toFixed(3);
  if (entry.mark === 'link') return [seconds, EVENT_SIGN, entry.happening].join('  ');
  if (entry.mark === 'board') return [seconds, EVENT_SIGN, `board ${entry.board}`].join('  ');
  return [seconds, SIGNS[entry.mark], toHex(entry.bytes)].join('  ');
}

/** The line without its words for people, trimmed. */
export function withoutNote(line: string): string {
  const at = line.indexOf('#');
  return (at < 0 ? line : line.slice(0, at)).trim();
}

/** Takes what `withoutNote` gives. Throws LineProblem. */
export function readLine(line: string): Entry {
  const [, time = '', sign = '', rest = ''] = COLUMNS.exec(line) ?? [];
  if (!SECONDS.test(time)) throw new LineProblem(`a line begins with its seconds, like 12.345, then a sign`);
  const atMs = Math.round(Number(time) * 1000);
  if (sign === EVENT_SIGN) return { atMs, ...readEvent(rest) };
  const mark = MARKS.get(sign);
  if (mark === undefined) {
    throw new LineProblem(`"${sign}" is no sign; there are ${[...MARKS.keys(), EVENT_SIGN].join(' ')}`);
  }
  return { atMs, mark, bytes: readBytes(rest) };
}

type Event = { mark: 'link' | 'board' } & (
  | Pick<Extract<Entry, { mark: 'link' }>, 'mark' | 'happening'>
  | Pick<Extract<Entry, { mark: 'board' }>, 'mark' | 'board'>
);

function readEvent(text: string): Event {
  if (isHappening(text)) return { mark: 'link', happening: text };
  const board = /^board[ \t]+(\S+)$/u.exec(text)?.[1];
  if (board === undefined) throw new LineProblem(`"${text}" is none of ${HAPPENINGS.join(', ')}, board NAME`);
  return { mark: 'board', board: readBoard(board) };
}

export function readBoard(text: string): BoardId {
  if (isBoardId(text)) return text;
  throw new LineProblem(`no board is called "${text}"`);
}

function readBytes(text: string): Uint8Array {
  const wrongByte = text.split(/[ \t]+/u).find((pair) => !/^[0-9a-f]{2}$/iu.test(pair));
  if (wrongByte === '') throw new LineProblem('there are no bytes');
  if (wrongByte !== undefined)
    throw new LineProblem(`"${wrongByte}" is no byte like 0F; words stand behind a #`);
  const bytes = fromHex(text);
  if (bytes.length > MAX_BYTES) throw new LineProblem(`more than ${MAX_BYTES} bytes in one line`);
  return bytes;
}
