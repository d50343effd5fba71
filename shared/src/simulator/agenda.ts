// The board's own time: runs what is due in the order of its due time, however late the platform's timer comes, and arms
// one timer for the next thing to do. With nothing to do no timer is armed. Knows no bytes and no board.

import type { Clock } from '../clock.ts';

// Work that takes the board's processor time: yields how many milliseconds the main loop is blocked, then continues.
// Bytes keep arriving meanwhile, because an interrupt takes them (S41).

export type Work = Generator<number, void, undefined>;

/** Nothing to do, in no time. */
export function* noWork(): Work {
  yield* [];
}

/** Something that happens by itself at a time. */
export interface Source {
  /** When it wants to go on; Infinity while there is nothing to do. */
  dueMs(): number;
  fire(): void;
}

interface Agenda {
  /** Milliseconds since power-up; while a source fires, exactly the time it was due. */
  readonly now: () => number;
  /** Runs what is due, then `act`, then what `act` made due. */
  readonly turn: <Result>(act: () => Result) => Result;
  end(): void;
}

// Sums of fractions of a millisecond are off by far less than this; without it a timer could fire "too early" for ever.
const TOLERANCE_MS = 1e-6;

/**
 * `startMs` is the board's age at creation. Sources due at the same time fire in the order given. `onTurnEnd` runs after
 * each turn, when it is safe to call the board again.
 */
export function createAgenda(
  clock: Clock,
  startMs: number,
  sources: () => readonly Source[],
  onTurnEnd: () => void,
): Agenda {
  const originMs = clock.now() - startMs;
  let nowMs = startMs;
  let inTurn = false;
  let ended = false;
  let alarm: { readonly dueMs: number; readonly cancel: () => void } | null = null;

  function next(): { dueMs: number; source: Source | null } {
    let found: { dueMs: number; source: Source | null } = { dueMs: Infinity, source: null };
    for (const source of sources()) {
      const dueMs = source.dueMs();
      if (dueMs < found.dueMs) found = { dueMs, source };
    }
    return found;
  }

  function catchUp(limitMs: number): void {
    for (let due = next(); due.dueMs <= limitMs + TOLERANCE_MS; due = next()) {
      nowMs = Math.max(nowMs, due.dueMs);
      due.source?.fire();
    }
    nowMs = Math.max(nowMs, limitMs);
  }

  function disarm(): void {
    alarm?.cancel();
    alarm = null;
  }

  function wake(): void {
    alarm = null;
    turn(() => undefined);
  }

  function arm(): void {
    const { dueMs } = next();
    if (alarm?.dueMs === dueMs) return;
    disarm();
    if (ended || dueMs === Infinity) return;
    alarm = { dueMs, cancel: clock.after(Math.max(0, originMs + dueMs - clock.now()), wake) };
  }

  function turn<Result>(act: () => Result): Result {
    if (inTurn || ended) return act();
    inTurn = true;
    try {
      catchUp(clock.now() - originMs);
      const result = act();
      catchUp(nowMs);
      return result;
    } finally {
      inTurn = false;
      arm();
      onTurnEnd();
    }
  }

  function end(): void {
    ended = true;
    disarm();
  }

  return { now: () => nowMs, turn, end };
}

// Things that happen to a board at a chosen time, each once.

export interface Happening {
  readonly atMs: number;
  readonly happen: () => void;
}

export function createSchedule(happenings: readonly Happening[]): Source {
  const ahead = happenings.filter(({ atMs }) => atMs < Infinity).sort((a, b) => a.atMs - b.atMs);
  return {
    dueMs: () => ahead[0]?.atMs ?? Infinity,
    fire: () => ahead.shift()?.happen(),
  };
}
