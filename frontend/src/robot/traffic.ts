// The log of the visit: packets and changes of the link, the newest 20,000, each with a number of its own; and battery answers that this
// page did not ask for. Knows what a session reports; what it means to a person is said elsewhere.

import timings from '../../../shared/protocol/timings.json' with { type: 'json' };
import { createStore, type StoreApi } from 'zustand/vanilla';
import type { BoardId } from '#shared/codec/families.ts';
import {
  createHappeningsReader,
  entryOf,
  createTape,
  type Tape,
  type TapeEntry,
} from '#shared/files/recording.ts';
import type { SessionState, Traffic } from '#shared/robot/state.ts';

export type LogEntry = TapeEntry;

export interface LogBounds {
  /** The oldest entry that is left. */
  readonly oldestId: number;
  /** What the next one will get. */
  readonly nextId: number;
}

export interface TrafficLog extends Pick<Tape, 'at' | 'content'> {
  readonly store: StoreApi<LogBounds>;
  /** `board`: what the board was taken for when the packet passed. */
  add(traffic: Traffic, board: BoardId): void;
  /** Keeps what changed since the snapshot before. */
  note(snapshot: Pick<SessionState, 'link' | 'latch'>, atMs: number, board: BoardId): void;
  clear(): void;
}

export function createTrafficLog(): TrafficLog {
  const tape = createTape();
  const bounds = (): LogBounds => ({ oldestId: tape.oldestId(), nextId: tape.nextId() });
  const store = createStore<LogBounds>(bounds);
  const happenings = createHappeningsReader();

  return {
    store,
    at: tape.at,
    content: tape.content,
    add(traffic, board) {
      tape.add(entryOf(traffic), board);
      store.setState(bounds());
    },
    note(snapshot, atMs, board) {
      const happened = happenings(snapshot);
      for (const happening of happened) tape.add({ atMs, mark: 'link', happening }, board);
      if (happened.length > 0) store.setState(bounds());
    },
    clear() {
      tape.clear();
      store.setState(bounds());
    },
  };
}

const { unsolicitedAfterMs, unsolicitedLimit } = timings.battery;

export type UnsolicitedAnswers = (traffic: Traffic) => void;

/**
 * Notices battery answers that were not requested here: then another program uses the same board, which neither a HID cable nor Bluetooth
 * forbids. For one link; `found` is called once. Its twin is UnsolicitedAnswers of robot/board/readings.py.
 */
export function createUnsolicitedAnswers(found: () => void): UnsolicitedAnswers {
  let askedAtMs = -Infinity;
  let count = 0;

  return (traffic) => {
    if (traffic.direction === 'out') {
      if (traffic.command?.kind === 'readBattery') askedAtMs = traffic.atMs;
      return;
    }
    if (!('report' in traffic) || traffic.report.kind !== 'battery') return;
    if (traffic.atMs - askedAtMs <= unsolicitedAfterMs) return;
    count += 1;
    if (count === unsolicitedLimit) found();
  };
}
