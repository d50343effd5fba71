// Tells the subscribers of a store only what is another: each of them looks through what it shows. Knows no store.

import type { StoreApi } from 'zustand/vanilla';

export function setChanged<State extends object>(store: StoreApi<State>, next: Partial<State>): void {
  const before = store.getState();
  const isSame = (Object.keys(next) as (keyof State)[]).every((key) => Object.is(next[key], before[key]));
  if (!isSame) store.setState(next);
}
