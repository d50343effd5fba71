// The newest entries of a visit, as many as a bug report needs, each kept as the line it is saved as: text takes a fraction
// of the memory of the same entry as values. Numbers them from 1. Knows no session.

import type { BoardId } from '../codec/families.ts';
import { readLine, writeLine, type Entry, type Recording } from './recording.ts';

export interface Tape {
  /** `board`: whose bytes they are; a change of it is an entry of its own. */
  add(entry: Entry, board: BoardId): void;
  /** The oldest that is still kept; `nextId` where there is none. */
  oldestId(): number;
  nextId(): number;
  /** Throws RangeError for an entry that is not kept. */
  at(id: number): TapeEntry;
  clear(): void;
  /** What is kept, and the board its first entry came from; `board` where nothing is kept. */
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
      throw new RangeError(`entry ${id} is not kept`);
    return { id, board, entry: readLine(line) };
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
