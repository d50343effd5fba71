// The layout for the window's width: a phone shows one part at a time, a desktop all of them.

import { useSyncExternalStore } from 'react';

export type Layout = 'phone' | 'tablet' | 'desktop';

const DESKTOP = '(min-width: 1100px)';
const TABLET = '(min-width: 700px)';

export function useLayout(): Layout {
  return useSyncExternalStore(subscribe, current);
}

function current(): Layout {
  if (matchMedia(DESKTOP).matches) return 'desktop';
  return matchMedia(TABLET).matches ? 'tablet' : 'phone';
}

function subscribe(changed: () => void): () => void {
  const queries = [matchMedia(DESKTOP), matchMedia(TABLET)];
  for (const query of queries) query.addEventListener('change', changed);
  return () => {
    for (const query of queries) query.removeEventListener('change', changed);
  };
}
