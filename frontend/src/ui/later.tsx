// Parts of the page that the first load leaves out. Each is fetched when it is first needed, all others once the page is idle, so that
// nothing is missing when the gateway disappears. STOP and the sliders are in the first load; dialogs, connecting and the choice of the
// board are fetched first.

import { useEffect, type ComponentType } from 'react';
import { createStore, useStore, type StoreApi } from 'zustand';
import { words } from '../i18n/words.ts';
import { Button } from './Button.tsx';
import { EmptyState } from './Panel.tsx';
import styles from './later.module.css';

interface Fetched<Part> {
  readonly part: Part | null;
  readonly isMissing: boolean;
}

export interface Later<Part> {
  readonly store: StoreApi<Fetched<Part>>;
  /** Once; again after it failed. Never rejects: `isMissing` says so. */
  fetch(): Promise<void>;
}

const all: Later<unknown>[] = [];

/** `guards`: safety comes before the rest. `onDemand`: large and rarely used, fetched only on demand. */
type Rank = 'guards' | 'rest' | 'onDemand';

export function later<Part>(load: () => Promise<Part>, rank: Rank = 'rest'): Later<Part> {
  const store = createStore<Fetched<Part>>(() => ({ part: null, isMissing: false }));
  let under: Promise<void> | null = null;
  async function fetchNow(): Promise<void> {
    try {
      store.setState({ part: await load(), isMissing: false });
    } catch {
      store.setState({ isMissing: true });
      under = null;
    }
  }
  const made = { store, fetch: () => (under ??= fetchNow()) };
  if (rank === 'guards') all.unshift(made);
  else if (rank === 'rest') all.push(made);
  return made;
}

/** One after the other, each when the browser has nothing else to do. */
export async function fetchRest(whenIdle: () => Promise<void>): Promise<void> {
  for (const part of all) {
    await whenIdle();
    await part.fetch();
  }
}

/** null until it is there. */
export function usePart<Part>(part: Later<Part>, isWanted = true): Fetched<Part> {
  useEffect(() => {
    if (isWanted) void part.fetch();
  }, [part, isWanted]);
  return useStore(part.store);
}

/** A component that is loaded on demand; until then its place has the height `room`, a CSS length. */
export function laterComponent<Props extends object>(
  load: () => Promise<ComponentType<Props>>,
  room: string,
  rank: Rank = 'rest',
): ComponentType<Props> {
  const made = later(load, rank);
  return function LaterComponent(props) {
    const { part: Part, isMissing } = usePart(made);
    if (Part !== null) return <Part {...props} />;
    return <div style={{ minHeight: room }}>{isMissing && <Missing part={made} />}</div>;
  };
}

export function Missing({ part }: { readonly part: Pick<Later<unknown>, 'fetch'> }) {
  return (
    <EmptyState
      className={styles.missing}
      title={words.later.missing}
      hint={words.later.missingHint}
      action={<Button onPress={() => void part.fetch()}>{words.later.again}</Button>}
    />
  );
}
