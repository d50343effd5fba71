// Sets a store's state only if a value changed, so that subscribers do not run for nothing.

import type { StoreApi } from 'zustand/vanilla';

export function setChanged<State extends object>(store: StoreApi<State>, next: Partial<State>): void {
  const before = store.getState();
  const isSame = (Object.keys(next) as (keyof State)[]).every((key) => Object.is(next[key], before[key]));
  if (!isSame) store.setState(next);
}
