// A recording as a text file: a header of `key: value` lines, then one line per entry. Strict about what it cannot read and
// lenient about line ends, a byte order mark, empty lines and comments. Linear in the size of the text.

import { FAMILIES, type BoardId } from '../codec/families.ts';
import { fromHex } from '../codec/packet.ts';
import {
  EVENT_SIGN,
  HAPPENINGS,
  SIGNS,
  writeLine,
  type ByteMark,
  type Entry,
  type Happening,
  type Header,
  type Recording,
} from './recording.ts';

const MARKS: ReadonlyMap<string, ByteMark> = new Map(
  Object.entries(SIGNS).map(([mark, sign]) => [sign, mark as ByteMark]),
);
/** Longer than any packet, any piece of noise and the filler after a cut packet. */
const MAX_BYTES = 512;
/** Time, sign, the rest. */
const COLUMNS = /^(\S+)[ \t]+(\S+)(?:[ \t]+(.*))?$/u;
const SECONDS = /^\d{1,9}(?:\.\d{1,3})?$/u;

/** Says why a line cannot be read. */
class LineProblem extends Error {
  override readonly name = 'LineProblem';
}

interface TextProblem {
  /** From 1; 0 where it is the whole text. */
  readonly line: number;
  readonly reason: string;
}

/** Not one entry of a text with problems is given: half a log proves nothing. */
type ReadResult =
  | { readonly recording: Recording }
  | { readonly recording: null; readonly problems: readonly TextProblem[] };

const FORMAT = '1';
const MAX_CHARS = 100_000_000;
/** A text of another kind would give one for each line. */
const MAX_PROBLEMS = 20;
const EXPLANATION = `# seconds  > sent  < received  <? noise  <| cut short  = link or board  # words, for people only`;

/** `noteOf` says each entry in words; they are not read back. */
export function writeRecording({ header, entries }: Recording, noteOf: (entry: Entry) => string): string {
  const lines = [
    `servodeck-log: ${FORMAT}`,
    `board: ${header.board}`,
    `port: ${oneLine(header.port)}`,
    `date: ${oneLine(header.date)}`,
    `app: ${oneLine(header.app)}`,
    ...header.expectations.map((expectation) => `expect: ${oneLine(expectation)}`),
    '',
    EXPLANATION,
  ];
  for (const entry of entries) {
    const note = oneLine(noteOf(entry));
    lines.push(note === '' ? writeLine(entry) : `${writeLine(entry)}  # ${note}`);
  }
  return `${lines.join('\n')}\n`;
}

const oneLine = (text: string): string => text.replace(/[\s\p{Cc}]+/gu, ' ').trim();

export function readRecording(text: string): ReadResult {
  if (text.length > MAX_CHARS) {
    return { recording: null, problems: [{ line: 0, reason: 'the file is larger than 100 MB' }] };
  }
  const reader = createReader();
  const problems: TextProblem[] = [];
  let number = 0;
  for (const line of linesOf(text)) {
    number += 1;
    const reason = reader.take(line);
    if (reason !== null) problems.push({ line: number, reason });
    if (problems.length === MAX_PROBLEMS) break;
  }
  if (problems.length === 0) problems.push(...reader.missing());
  return problems.length === 0 ? { recording: reader.recording() } : { recording: null, problems };
}

/** Trimmed, so that every line end will do. One at a time: an array of all lines would hold a large text twice. */
function* linesOf(text: string): Generator<string> {
  let from = text.startsWith('\uFEFF') ? 1 : 0;
  while (from < text.length) {
    const end = text.indexOf('\n', from);
    const to = end < 0 ? text.length : end;
    yield text.slice(from, to).trim();
    from = to + 1;
  }
}

function createReader() {
  const header = new Map<string, string>();
  const expectations: string[] = [];
  const entries: Entry[] = [];

  function takeHeader(key: string, value: string): void {
    if (entries.length > 0)
      throw new LineProblem(`"${key}:" stands behind packets; it belongs to the header`);
    if (key === 'expect') expectations.push(value);
    else if (!KEYS.includes(key)) {
      throw new LineProblem(`"${key}:" is none of ${[...KEYS, 'expect'].join(', ')}`);
    } else if (header.has(key)) throw new LineProblem(`"${key}:" comes twice`);
    if (key === FORMAT_KEY && value !== FORMAT)
      throw new LineProblem(`this log has format ${value}; format ${FORMAT} can be read`);
    if (key === 'board') readBoard(value);
    header.set(key, value);
  }

  function takeEntry(line: string): void {
    const entry = readLine(line);
    if (entry.atMs < (entries.at(-1)?.atMs ?? 0)) throw new LineProblem('time runs backwards here');
    entries.push(entry);
  }

  return {
    /** Null, or why the line cannot be read. */
    take(line: string): string | null {
      const [, key, value = ''] = HEADER_LINE.exec(line) ?? [];
      const content = withoutNote(line);
      try {
        if (key !== undefined) takeHeader(key, value.trim());
        else if (content !== '') takeEntry(content);
        return null;
      } catch (problem) {
        if (problem instanceof LineProblem) return problem.message;
        throw problem;
      }
    },
    missing: (): TextProblem[] =>
      [FORMAT_KEY, 'board']
        .filter((key) => !header.has(key))
        .map((key) => ({ line: 0, reason: `the header has no "${key}:"` })),
    recording(): Recording {
      const value = (key: keyof Header): string => header.get(key) ?? '';
      return {
        header: {
          board: readBoard(value('board')),
          ...{ port: value('port'), date: value('date'), app: value('app') },
          expectations,
        },
        entries,
      };
    },
  };
}

const FORMAT_KEY = 'servodeck-log';
const KEYS: readonly string[] = [FORMAT_KEY, 'board', 'port', 'date', 'app'];
const HEADER_LINE = /^([a-z-]+):(.*)$/u;

/** The line without its words for people, trimmed. */
function withoutNote(line: string): string {
  const at = line.indexOf('#');
  return (at < 0 ? line : line.slice(0, at)).trim();
}

/** Takes what `withoutNote` gives. Throws LineProblem. */
function readLine(line: string): Entry {
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

function readBoard(text: string): BoardId {
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

export function isBoardId(text: string): text is BoardId {
  return text === 'unknown' || Object.hasOwn(FAMILIES, text);
}

function isHappening(text: string): text is Happening {
  return (HAPPENINGS as readonly string[]).includes(text);
}
