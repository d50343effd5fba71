// The newest packets of the link, at most 500, each with a number of its own. Knows no session.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Traffic } from '#shared/session/state.ts';

export interface LogEntry {
  readonly id: number;
  readonly traffic: Traffic;
}

export interface TrafficLog {
  readonly store: StoreApi<readonly LogEntry[]>;
  add(traffic: Traffic): void;
  clear(): void;
}

const CAPACITY = 500;

export function createTrafficLog(): TrafficLog {
  const store = createStore<readonly LogEntry[]>(() => []);
  let nextId = 1;
  return {
    store,
    add(traffic) {
      const entry = { id: nextId++, traffic };
      store.setState((entries) => [...entries.slice(1 - CAPACITY), entry], true);
    },
    clear: () => store.setState([], true),
  };
}
