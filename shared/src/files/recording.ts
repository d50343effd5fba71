// A recording of a link: its entries, each as a line of text that a person can read and edit: `12.345  >  55 55 02 0F  # Read the battery`.
// Entries are made from a robot's events and understood again; the newest of a visit are stored as lines, as many as a bug report needs,
// which take a fraction of the memory of values. Knows no file.

import type { BoardId, Family } from '../codec/families.ts';
import { toHex, fromHex } from '../codec/packet.ts';
import { parseCommand, parseReport } from '../codec/parse.ts';
import type { SessionState, Traffic } from '../robot/state.ts';

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

export type PacketEntry = Extract<Entry, { readonly bytes: Uint8Array }>;

export function entryOf(traffic: Traffic): PacketEntry {
  const { atMs, bytes } = traffic;
  if ('noise' in traffic) return { atMs, mark: traffic.noise, bytes };
  return { atMs, mark: traffic.direction === 'out' ? 'sent' : 'received', bytes };
}

export function trafficOf({ atMs, mark, bytes }: PacketEntry, family: Family): Traffic {
  if (mark === 'garbage' || mark === 'truncated') return { atMs, direction: 'in', bytes, noise: mark };
  const packet = { command: bytes[3] ?? 0, params: bytes.subarray(4) };
  if (mark === 'received') return { atMs, direction: 'in', bytes, report: parseReport(packet, family) };
  return { atMs, direction: 'out', bytes, command: parseCommand(packet) };
}

const LINK_HAPPENINGS: Readonly<Partial<Record<SessionState['link']['status'], Happening>>> = {
  ready: 'opened',
  lost: 'lost',
  closed: 'closed',
};

type Watched = Pick<SessionState, 'link' | 'latch'>;

/** Gives what happened between one snapshot and the next; the first is compared with a closed link. */
export function createHappeningsReader(): (snapshot: Watched) => readonly Happening[] {
  let link: Happening = 'closed';
  let latch: SessionState['latch'] = null;

  return (snapshot) => {
    const happened: Happening[] = [];
    const next = LINK_HAPPENINGS[snapshot.link.status] ?? link;
    if (next !== link) happened.push(next);
    if (snapshot.latch !== latch && isOurStop(snapshot.latch)) happened.push('stopped');
    else if (latch === null && snapshot.latch !== null) happened.push('latched');
    // A link that is closed takes its latch along; motion was not resumed.
    if (latch !== null && snapshot.latch === null && next === 'opened') happened.push('resumed');
    link = next;
    latch = snapshot.latch;
    return happened;
  };
}

/** Each stop from here begins with a latch of its own, also where one is set already. */
function isOurStop(latch: SessionState['latch']): boolean {
  return latch?.stop === 'sending' && (latch.reason === 'pressed' || latch.reason === 'battery');
}

export interface Tape {
  /** `board`: whose bytes they are; a change of it is an entry of its own. */
  add(entry: Entry, board: BoardId): void;
  /** The oldest that is left; `nextId` where there is none. */
  oldestId(): number;
  nextId(): number;
  /** Throws RangeError for an entry that is not there. */
  at(id: number): TapeEntry;
  clear(): void;
  /** What is left, and the board its first entry came from; `board` where nothing is. */
  content(board: BoardId): { readonly board: BoardId; readonly entries: Recording['entries'] };
}

export interface TapeEntry {
  readonly id: number;
  readonly board: BoardId;
  readonly entry: Entry;
}

interface Stretch {
  readonly fromId: number;
  readonly board: BoardId;
}

/** Ten minutes of dragging a slider: 30 packets a second. Measured: 2 MB for moves of six servos. */
export const CAPACITY = 20_000;

export function createTape(capacity = CAPACITY): Tape {
  const lines: string[] = [];
  let oldest = 1;
  let next = 1;
  /** Oldest first; empty until the first entry. */
  let stretches: Stretch[] = [];

  function keep(entry: Entry): void {
    lines[next % capacity] = writeLine(entry);
    next += 1;
    if (next - oldest > capacity) oldest += 1;
    while ((stretches[1]?.fromId ?? Infinity) <= oldest) stretches.shift();
  }

  function boardAt(id: number): BoardId | undefined {
    return stretches.findLast(({ fromId }) => fromId <= id)?.board;
  }

  function at(id: number): TapeEntry {
    const board = boardAt(id);
    const line = lines[id % capacity];
    if (id < oldest || id >= next || board === undefined || line === undefined)
      throw new RangeError(`entry ${id} is not stored`);
    return { id, board, entry: entryIn(line) };
  }

  return {
    add(entry, board) {
      const last = stretches.at(-1)?.board;
      if (last !== board) stretches.push({ fromId: next, board });
      if (last !== undefined && last !== board) keep({ atMs: entry.atMs, mark: 'board', board });
      keep(entry);
    },
    oldestId: () => oldest,
    nextId: () => next,
    at,
    clear() {
      lines.length = 0;
      oldest = next;
      stretches = stretches.slice(-1);
    },
    content(board) {
      const entries = Array.from({ length: next - oldest }, (_, index) => at(oldest + index).entry);
      return { board: boardAt(oldest) ?? board, entries };
    },
  };
}

/** Back from `writeLine`, and from nothing else: the lines of a file are checked by recordingText.ts. */
function entryIn(line: string): Entry {
  const [seconds, sign, rest = ''] = line.split('  ');
  const atMs = Math.round(Number(seconds) * 1000);
  const [happening, board] = rest.split(' ');
  if (sign !== EVENT_SIGN) {
    const mark = MARKS.find((one) => SIGNS[one] === sign) ?? 'garbage';
    return { atMs, mark, bytes: fromHex(rest) };
  }
  return board === undefined
    ? { atMs, mark: 'link', happening: happening as Happening }
    : { atMs, mark: 'board', board: board as BoardId };
}

const MARKS = Object.keys(SIGNS) as readonly ByteMark[];
